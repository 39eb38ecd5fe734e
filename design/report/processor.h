#pragma once

#include <istream>
#include <string>

namespace evenglow::design {

/// Model of this machine's CPU as the system tells it; empty where it does not.
std::string processor_name();

/// The same from the text of /proc/cpuinfo: the first line "model name", or "Model" where there is none.
std::string processor_name(std::istream& cpuinfo);

}  // namespace evenglow::design
