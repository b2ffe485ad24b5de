// Perspective shadow map (Stamminger, Drettakis 2002): the map is drawn in the space after the camera's perspective, where
// near things are large. Course, "Perspective Shadow Maps"; the fit is in psm_view.cpp. `behind=` and `shift=` are the
// course's remedies for casters behind the eye and for a close near plane; `fit=cube` is the original map of the whole view
// frustum, which a close near plane ruins, `fit=box` its restriction to the scene's bounding box. Departures: casters before
// the light's near plane are kept by depth clamping, which is also how the negative near plane is done; a light behind the
// viewer, a sink of rays after the perspective, needs no inverted depth test, because depth is made to grow along its rays.
#include "techniques/contract/entry.h"
#include "techniques/maps/sm-psm/psm_view.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {
namespace {

PsmOptions optionsFrom(const Parameters& p) {
    PsmOptions options;
    options.shift = p.real("shift");
    options.behindEye = p.text("behind") == "negative-near" ? BehindEye::NegativeNear
                        : p.text("behind") == "move-back"   ? BehindEye::MoveBack
                                                            : BehindEye::Lost;
    options.body = p.text("fit") == "cube" ? PsmBody::Cube : PsmBody::Box;
    return options;
}

} // namespace

Entry smPsm() {
    std::vector<Parameter> parameters = withNormalOffset(withDepthMapParameters({
        {"behind", "negative-near", OneOf{{"lost", "move-back", "negative-near"}},
         "casters behind the eye: lost, or kept by either remedy", "course, Shadows From the Back"},
        {"shift", "0", RealRange{0, 1e4}, "metres that the virtual camera stands behind the camera",
         "course, Near/Far Selection"},
        {"fit", "box", OneOf{{"cube", "box"}}, "the map holds the whole view frustum, or the scene's box within it",
         "course, Deep Light Sources"},
    }));
    return {.id = "sm-psm",
            .title = "Perspective shadow map",
            .source = {Document::Course, "Perspective Shadow Maps"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .figures = {{"near_depth", "share of post-perspective depth between the near plane and twice its distance"}},
            .variants = {""},
            .make = [](const Parameters& p) {
                const PsmOptions options = optionsFrom(p);
                const Bias bias = biasFrom(p);
                auto map = std::make_unique<DepthMap>(p.integer("map"), bias, Lookup::Compare,
                                                      options.behindEye == BehindEye::Lost);
                const FitView fit = [options](const Frame& frame) {
                    return fitPsm(frame.hardLight, frame.snapshot, frame.snapshot.camera, frame.aspect(), options);
                };
                const ReportFigures report = [options](const Frame& frame) -> std::map<std::string, double> {
                    const Camera eye = virtualCamera(frame.snapshot, frame.snapshot.camera, frame.aspect(), options);
                    return {{"near_depth", nearDepthShare(frame.snapshot.camera, eye, frame.aspect())}};
                };
                return makeSingleMap(std::move(map), fit, bias, report);
            }};
}

} // namespace shadowbench::techniques
