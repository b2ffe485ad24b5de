// What the page of a scene's cells shows and where it lies.
#pragma once

#include "harness/cells/kept_images.h"
#include "harness/records/record.h"
#include "site/site_writer.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::site {

/// A truth of a scene. `data` and `picture` are addresses from the folder cells/ of the site, without ".js".
struct ShownTruth {
    std::string name, label, data, picture;
    bool hasEdges = false; // exact ones
};

struct ShownSequence {
    int count = 0;                               // frames, the scored one with them
    std::string picture, truth, flicker, moving; // addresses; the truth's name
};

struct ShownCell {
    std::string slug, variant, error; // its place in addresses; as people see it; "mismatch 4.87 %"
    std::string truth;                // that its error is about
    std::string data, picture, difference;
    std::optional<ShownSequence> sequence;
};

struct ShownScene {
    std::string slug, title;
    int width = 0, height = 0;
    std::vector<ShownTruth> truths;
    std::vector<ShownCell> cells;
    std::string shading = {}; // address of what makes shaded pictures; "": the run has kept none
};

/// The truth that a record's headline error is about, of those that there are.
std::string truthOf(const Record& record, const std::vector<std::string>& truths);

/// The name of the truth that its moving frames are compared with.
std::string movingTruthOf(const Record& record);

/// "exact, of the light's centre" …
std::string truthLabel(const std::string& name);

/// A script that tells the viewer of the scene.
std::string catalogueScript(const ShownScene& scene);

/// HTML of the page's main part; `back`: the page that it belongs to.
std::string cellsPage(const ShownScene& scene, const Link& back);

/// Technique less truth, in the colours of the viewer: orange false shadow, blue leak, full colour at ±1/gain.
Image<glm::vec3> differencePicture(const Image<float>& v, const KeptTruth& truth, int gain = 1);

/// V in grey, with colours where nothing is scored.
Image<glm::vec3> visibilityPicture(const Image<float>& v, const KeptTruth& truth);

} // namespace shadowbench::site
