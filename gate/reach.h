// What a commit can change: which sources can decide the result of a cell, so that a gate need not measure it on both sides.
// cmake/reach.cmake finds the units of sources and who uses whom.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace shadowbench::gate {

class Reach {
public:
    /// Nothing is known: as of programs that do not say.
    Reach() = default;

    /// This program's.
    static Reach own();

    /// As cmake/reach.cmake writes it: "NAME HASH USED …", a line each. Throws BadInput for a line without hash.
    explicit Reach(const std::string& text);
    [[nodiscard]] const std::string& text() const { return text_; }

    /// The units that can decide what a built-in technique gives on a scene, a built-in one or a file: the folder of the
    /// technique and what that uses, the scene's file and "*", all that no unit holds. None where that is not known, as of a
    /// technique that is no folder.
    [[nodiscard]] std::set<std::string> units(const std::string& technique, const std::string& scene) const;

    /// Hash of these: where it is equal in two programs, so are their results.
    [[nodiscard]] std::optional<std::string> key(const std::string& technique, const std::string& scene) const;

    /// Hash of the sources of one unit.
    [[nodiscard]] std::optional<std::string> hash(const std::string& unit) const;

    /// The unit of what makes figures of shaders, beside what draws.
    static constexpr const char* shaderFigures = "shader-figures";

private:
    struct Unit {
        std::string hash;
        std::vector<std::string> used;
    };

    std::string text_;
    std::map<std::string, Unit> units_;
};

} // namespace shadowbench::gate
