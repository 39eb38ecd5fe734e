#include "tracer/polarized_bsdf/lobe_parameters.h"

namespace evenglow::tracer {
namespace {

using P = LobeParameters;

// A lobe narrower than 0.01 (0.6 degrees) would slip through the grid that the model is solved on.
constexpr double kNarrow = 0.01, kWide = 2.0, kBright = 1e9;

constexpr LobeParameter kParameters[] = {
    {"sx", "width of the narrow reflected lobe along the pass axis, direction cosines", &P::sx, kNarrow, kWide},
    {"sy", "width of the narrow reflected lobe along the block axis", &P::sy, kNarrow, kWide},
    {"s2", "width of the middle reflected lobe", &P::s2, kNarrow, kWide},
    {"s3p", "width of the wide reflected lobe of pass light", &P::s3p, kNarrow, kWide},
    {"s3b", "width of the wide reflected lobe of block light", &P::s3b, kNarrow, kWide},
    {"p1_cd_m2", "amplitude of the narrow reflected lobe of pass light", &P::p1, 0, kBright},
    {"p3_cd_m2", "amplitude of the wide reflected lobe of pass light", &P::p3, 0, kBright},
    {"b1_cd_m2", "amplitude of the narrow reflected lobe of block light", &P::b1, 0, kBright},
    {"b2_cd_m2", "amplitude of the middle reflected lobe of block light", &P::b2, 0, kBright},
    {"b3_cd_m2", "amplitude of the wide reflected lobe of block light", &P::b3, 0, kBright},
    {"t1", "width of the narrow transmitted lobe", &P::t1, kNarrow, kWide},
    {"t2", "width of the middle transmitted lobe", &P::t2, kNarrow, kWide},
    {"t3", "width of the wide transmitted lobe", &P::t3, kNarrow, kWide},
    {"a1_pass_cd_m2", "amplitude of the narrow transmitted lobe of pass light", &P::a1, 0, kBright},
    {"a2_pass_cd_m2", "amplitude of the middle transmitted lobe of pass light", &P::a2, 0, kBright},
    {"a3_pass_cd_m2", "amplitude of the wide transmitted lobe of pass light", &P::a3, 0, kBright},
    {"a2_block_cd_m2", "amplitude of the middle transmitted lobe of block light", &P::a2b, 0, kBright},
    {"a3_block_cd_m2", "amplitude of the wide transmitted lobe of block light", &P::a3b, 0, kBright},
    {"e0_lx", "illuminance that the amplitudes belong to", &P::e0, 1e-6, kBright},
    {"absorption", "share of the light that the film absorbs", &P::absorption, 0, 0.99},
    {"refractive_index", "of the film's faces", &P::refractive_index, 1.0001, 4},
};

}  // namespace

std::span<const LobeParameter> lobe_parameters() {
  return kParameters;
}

}  // namespace evenglow::tracer
