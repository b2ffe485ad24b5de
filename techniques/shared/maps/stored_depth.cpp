#include "techniques/shared/maps/stored_depth.h"

#include "techniques/shared/maps/midpoint_map.h"

namespace shadowbench::techniques {

Parameter storedDepthParameter() {
    return {"depth", "basic", OneOf{{"basic", "midpoint"}}, "nearest depth, or the mean of first and second surface",
            "Zápotocký 4.4.2"};
}

std::unique_ptr<ShadowMap> storedDepthMap(const Parameters& parameters, Lookup lookup) {
    const int side = parameters.integer("map");
    if (parameters.text("depth") == "midpoint") return std::make_unique<MidpointMap>(side, lookup);
    return std::make_unique<DepthMap>(side, biasFrom(parameters), lookup);
}

LinearisedMap storedLinearisedMap(const Parameters& parameters) {
    const int side = parameters.integer("map");
    if (parameters.text("depth") == "midpoint") return LinearisedMap(std::make_unique<MidpointMap>(side, Lookup::Raw));
    return {side, biasFrom(parameters)};
}

} // namespace shadowbench::techniques
