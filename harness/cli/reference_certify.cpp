// `shadowbench reference --certify`.
#include "base/parallel.h"
#include "base/progress_line.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/cgal/hard/exact.h"
#include "harness/cli/reference.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using groundtruth::Certificate;

void printText(const NamedRequest& named, const Certificate& c) {
    fmt::print("{} frame {}: POV-Ray with {} light samples against the exact visible fraction\n", named.scene, named.frame,
               named.request.samples);
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

} // namespace

ExitCode certifyReference(const ReferenceOptions& options) {
    const NamedRequest named = requestOf(options);
    const groundtruth::Request& request = named.request;
    const int threads = hardwareThreads();
    ProgressLine line(named.scene, 2, options.quiet);
    const groundtruth::PrimaryHits primary = groundtruth::hard::primaryHits(request.snapshot, request.size);
    const groundtruth::povray::Render image =
        groundtruth::povray::render(request.snapshot, request.size, request.samples, {.threads = threads},
                                    [&](double share, std::string_view what) { line.show(0, share, what); });
    const Certificate certificate =
        groundtruth::certify(request, image, primary, options.points, threads,
                             [&](double share, std::string_view what) { line.show(1, share, what); });
    line.show(2, 0, "");
    options.json ? printJson(named, certificate) : printText(named, certificate);
    groundtruth::requireCertified(certificate, request.samples);
    return ExitCode::Pass;
}

} // namespace shadowbench
