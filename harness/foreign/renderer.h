// Renderers that are not ours, described in a TOML file (docs/external.md): a list of [[renderer]].
#pragma once

#include "harness/foreign/foreign_row.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::foreign {

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
    bool moving = true; // it renders the moving frames too, not the last still one alone
    std::chrono::milliseconds limit{std::chrono::minutes(10)};
    std::vector<std::pair<std::string, std::string>> settings;    // parameters of its rows, sorted by name
    std::vector<std::pair<std::string, std::string>> environment; // variables beside ours
    std::filesystem::path folder;                                 // of the TOML file: where the command runs
    std::string text;                                             // the entry, with keys sorted and without comments
    int line = 1;                                                 // of the file, where the entry begins
};

/// The renderers of a file, in its order. Throws BadInput naming file, line and key of what is wrong or unknown, with near
/// matches.
std::vector<Renderer> readRenderers(const std::filesystem::path& file);

/// `text` with the placeholders replaced; `quoted`: by words that the shell takes as they are.
std::string filledIn(std::string text, const std::vector<std::pair<std::string, std::string>>& values, bool quoted);

} // namespace shadowbench::foreign
