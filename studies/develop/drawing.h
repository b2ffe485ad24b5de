// A technique folder's rows on some scenes, drawn and scored by a program of their own: a shader that hangs or crashes ends
// that one.
#pragma once

#include "scene/scene.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::develop {

struct Request {
    std::filesystem::path folder;
    std::vector<std::string> scenes, techniques; // ids or files; variants, as for `run`
    Profile profile = Profile::Gate;
    std::filesystem::path cache;
    std::chrono::milliseconds limit{60'000}; // of one drawing
};

/// A figure of a row: that with the name "error" ranks it.
struct Figure {
    std::string name;
    bool isShare = false; // of pixels
    double value = 0;
};

/// The row's pictures, as PNG.
struct Pictures {
    std::string visibility, truth, error;
};

struct Row {
    std::string scene, variant;
    std::string error; // one line, where there are no figures and pictures
    std::vector<Figure> figures;
    std::shared_ptr<const Pictures> pictures;
};

struct Drawing {
    std::vector<Row> rows;
    std::string error;                 // one line, where not even rows are known
    std::vector<std::string> warnings; // a line each, of the folder
    double seconds = 0;
};

/// Has a row on a scene of 256² end after ten seconds, unless the user's environment has another limit: many times what its
/// frames take.
void limitRows();

/// For all rows together. Only where several hang a drawing is longer under way.
std::chrono::milliseconds limitFor(const std::vector<Scene>& scenes);

/// Computes what is true of the scenes, unless the cache has it: the long part, which no limit of time may end.
void computeTruths(const std::vector<Scene>& scenes, const std::filesystem::path& cache);

/// Draws the folder as it is, with files in `room`, a folder for nothing else. Nothing if `stops`, which is asked often,
/// says that nobody wants it any more. Throws Inconclusive when the user interrupts.
std::optional<Drawing> draw(const Request& request, const std::filesystem::path& room, const std::function<bool()>& stops);

/// The words after `shadowbench` that draw and score the same for good.
std::vector<std::string> runWords(const Request& request);

} // namespace shadowbench::develop
