// A technique that draws one shadow map and tests each receiver against it once: they differ in how the map is fitted.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/shared/maps/depth_map.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// How a map is fitted to a frame.
using FitView = std::function<LightView(const Frame&)>;

/// What such a technique reports of a frame (`Technique::figures`).
using ReportFigures = std::function<std::map<std::string, double>(const Frame&)>;

/// `bias`: that of the receivers; the map has its own.
std::unique_ptr<Technique> makeSingleMap(std::unique_ptr<ShadowMap> map, FitView fit, Bias bias = {},
                                         ReportFigures figures = {});

/// The same over a depth map with these parameters.
std::unique_ptr<Technique> makeSingleMap(const Parameters& parameters, FitView fit);

/// `sm-uniform`: the light frustum fitted to the whole scene.
LightView uniformView(const Frame& frame);

/// `sm-focused`.
LightView focusedView(const Frame& frame);

/// `sm-lispsm`.
LightView lispsmView(const Frame& frame);

} // namespace shadowbench::techniques
