#include "tracer/transport/recording_history.h"

namespace evenglow::tracer {

template class BasicPlanarHistory<MeridianLight, RecordingObserver>;

}  // namespace evenglow::tracer
