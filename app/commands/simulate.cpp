#include "app/backlight_run.h"
#include "app/commands/commands.h"
#include "app/output_directory.h"
#include "app/result_text.h"
#include "design/engine/state_file.h"
#include "design/report/writer_registry.h"

namespace evenglow::app {

int simulate_command(const Session& session) {
  const auto& file = session.options.files.front();
  Run run = read_run(file, session.options);
  agree_on_input(session.options, run_identity(run, "simulate"), session.stop);
  const auto directory = output_directory(session.options, file);
  const OutputLock lock = claim_directory(directory, {}, session.options, disk_bytes(run));
  const auto formats = run.output;
  Progress progress(session.options.quiet, session.options.json_progress);
  const RunContext context{session.options, progress, session.stop, session.program_arguments};
  const auto report = run_simulation(std::move(run), context);
  if (!report) {
    progress.line("interrupted: nothing was written");
    return kInterrupted;
  }
  lock.check();
  clear_results(directory);
  design::write_report(*report, formats, directory);
  design::remove_state(directory / kCheckpointName);
  print_result(*report, directory);
  return kDone;
}

}  // namespace evenglow::app
