#include "app/backlight_run.h"
#include "app/commands/commands.h"
#include "app/front_run.h"
#include "app/output_directory.h"
#include "app/result_text.h"
#include "design/report/writer_registry.h"

namespace evenglow::app {

int design_command(const Session& session) {
  const auto& file = session.options.files.front();
  Run run = read_run(file, session.options, Purpose::kDesign);
  agree_on_input(session.options, run_identity(run, "design"), session.stop);
  const auto directory = output_directory(session.options, file);
  const OutputLock lock = claim_directory(directory, {}, session.options, disk_bytes(run));
  const auto formats = run.output;
  Progress progress(session.options.quiet, session.options.json_progress);
  const RunContext context{
      session.options, progress, session.stop, session.program_arguments, 0, directory / kCheckpointName, &lock};
  const auto made = run_design_job(std::move(run), context);
  if (!made) {
    progress.line("interrupted: --resume goes on from the last whole step");
    return kInterrupted;
  }
  write_results(directory, lock, [&] {
    clear_results(directory);
    design::write_report(made->report, formats, directory);
    if (made->write_more) made->write_more();
  });
  remove_point_checkpoints(context.checkpoint);
  print_result(made->report, directory);
  return kDone;
}

}  // namespace evenglow::app
