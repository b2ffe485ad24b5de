// Renderers that are not ours, described in a TOML file (docs/external.md): a list of [[renderer]].
#pragma once

#include "harness/foreign/foreign_row.h"
#include "scene/camera.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::foreign {

/// What a row may set (docs/scoreboard.md, "Divisions").
enum class Division {
    Defaults,  // nothing that its engine does not set itself
    EqualMaps, // the map's size and nothing else
    Tuned,     // what the engine's documents recommend
};

/// The engine that a list is of, and who answers for the adapter.
struct Client {
    std::string engine, version, maintainer;
    std::string retired = {}; // why it is no longer scored, and since which edition; empty: it is scored
};

struct Renderer {
    std::string id;            // as ForeignRow::id
    std::string title, source; // for people; may be empty
    // The words of a program's command line. In each, {scene}, {frames} and {out} stand for the exported folder, the numbers
    // of the frames ("59,60,61") and the folder for images.
    std::vector<std::string> command;
    bool isShellLine = false; // the last word is a line for the shell, in which they are quoted
    Definition definition = Definition::Hard;
    Encoding encoding = Encoding::OfFormat;
    std::string channel; // as ForeignRow::channel, and so are these
    Depth depth = Depth::AlongView;
    bool remembers = false, leaveOutEdges = false, force = false;
    bool moving = true;            // it renders the moving frames too, not the last still one alone
    std::vector<LightKind> lights; // that it draws; empty: each that its definition fits
    Division division = Division::Defaults;
    std::string advice; // of a tuned one: where the engine's documents recommend its settings, and in which words
    std::chrono::milliseconds limit{std::chrono::minutes(10)};
    std::vector<std::pair<std::string, std::string>> settings;    // parameters of its rows, sorted by name
    std::vector<std::pair<std::string, std::string>> environment; // variables beside ours
    std::filesystem::path folder;                                 // of the TOML file: where the command runs
    std::string text;                                             // the entry, with keys sorted and without comments
    int line = 1;                                                 // of the file, where the entry begins

    [[nodiscard]] bool draws(LightKind kind) const;
};

/// The [client] of a file; nothing where it has none. Throws as below.
std::optional<Client> readClient(const std::filesystem::path& file);

/// The renderers of a file, in its order; each has the keys of [shared] that it does not say itself. Throws BadInput naming
/// file, line and key of what is wrong or unknown, with near matches.
std::vector<Renderer> readRenderers(const std::filesystem::path& file);

/// `text` with the placeholders replaced; `quoted`: by words that the shell takes as they are.
std::string filledIn(std::string text, const std::vector<std::pair<std::string, std::string>>& values, bool quoted);

} // namespace shadowbench::foreign
