// The reference under an environment light: the share of the unoccluded irradiance that arrives.
#pragma once

#include "base/progress.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/contract/reference.h"
#include "groundtruth/povray/sky.h"

namespace shadowbench::groundtruth {

/// Rendered by POV-Ray and measured against exact directions at `points` pixels; nothing is refused.
struct MeasuredSky {
    Reference reference; // its sigma is scaled to the certificate's rms error; without key and seconds
    Certificate certificate;
};
MeasuredSky measuredSky(const Request& request, int points, const povray::SkyRecipe& recipe = {},
                        const Progress& progress = {});

/// The same with skyCertificatePointCount points. Throws BadInput for a scene that the camera's planes cut, Inconclusive if
/// POV-Ray is missing or fails or its render is not certified, InternalError if its camera is misaligned.
Reference skyReference(const Request& request, const Progress& progress = {});

} // namespace shadowbench::groundtruth
