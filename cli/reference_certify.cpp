// `shadowbench reference --certify`.
#include "base/parallel.h"
#include "base/progress_line.h"
#include "cli/reference.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/certify/sky_certificate.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/sky_reference.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using groundtruth::Certificate;

void printText(const NamedRequest& named, const Certificate& c) {
    const bool sky = named.request.snapshot.light.isEnvironment();
    fmt::print("{} frame {}: POV-Ray with {} against {}\n", named.scene, named.frame,
               fmt::format("{} {}", named.request.samples, sky ? "directions of the sky" : "light samples"),
               sky ? fmt::format("{} exact ones", groundtruth::certificateDirections) : "the exact visible fraction");
    fmt::print("  points                 {}, {} of them in the penumbra\n", c.points, c.penumbra);
    fmt::print("  wrong fully lit/umbra  {}\n", c.wrong);
    fmt::print("  mean error             {:+.6f}\n", c.bias);
    fmt::print("  rms error              {:.6f}\n", c.rms);
    fmt::print("  with half the samples  {:.6f}\n", c.rmsHalf);
    fmt::print("  with a quarter         {:.6f}\n", c.rmsQuarter);
    fmt::print("  independent samples    {:.6f} to be expected\n", c.independent);
    fmt::print("  largest error          {:.6f}\n", c.largest);
    fmt::print("  estimated sigma        {:.6f} before it is scaled to the rms error\n", c.sigma);
}

void printJson(const NamedRequest& named, const Certificate& certificate) {
    nlohmann::ordered_json json{{"scene", named.scene}, {"frame", named.frame}, {"samples", named.request.samples}};
    for (const auto& [key, value] : groundtruth::measured(certificate)) json[key] = value;
    fmt::print("{}\n", json.dump(2));
}

Certificate certificateOf(const groundtruth::Request& request, int points, ProgressLine& line) {
    const auto step = [&](int at) {
        return [&line, at](double share, std::string_view what) { line.show(at, share, what); };
    };
    if (request.snapshot.light.isEnvironment())
        return groundtruth::measuredSky(request, points, {},
                                        [&](double share, std::string_view what) {
                                            line.show(share < 0.5 ? 0 : 1, share < 0.5 ? 2 * share : 2 * share - 1, what);
                                        })
            .certificate;
    const int threads = availableThreads();
    const groundtruth::PrimaryHits primary = groundtruth::hard::primaryHits(request.snapshot, request.size);
    const groundtruth::povray::Render image =
        groundtruth::povray::render(request.snapshot, request.size, request.samples, {.threads = threads}, step(0));
    return groundtruth::certify(request, image, primary, points, threads, step(1));
}

void requireCertified(const groundtruth::Request& request, const Certificate& certificate) {
    if (request.snapshot.light.isEnvironment()) return groundtruth::requireSkyCertified(certificate, request.samples);
    groundtruth::requireCertified(certificate, request.samples);
}

} // namespace

ExitCode certifyReference(const ReferenceOptions& options) {
    const NamedRequest named = requestOf(options);
    ProgressLine line(named.scene, 2, options.quiet);
    const Certificate certificate = certificateOf(named.request, options.points, line);
    line.show(2, 0, "");
    options.json ? printJson(named, certificate) : printText(named, certificate);
    requireCertified(named.request, certificate);
    return ExitCode::Pass;
}

} // namespace shadowbench
