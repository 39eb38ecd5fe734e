#pragma once

namespace evenglow::core {

/// Was this process started by a launcher of MPI programs (mpirun, srun)? Told by the variables that these set, so that
/// a program that is started alone never begins MPI.
bool started_by_launcher();

/// How many processes the launcher started, as its variables say; 1 if none.
int launched_ranks();

}  // namespace evenglow::core
