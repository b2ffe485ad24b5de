// A copy of the tracked source files in a folder of its own, in which faults are planted and built.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::mutants {

class TreeCopy {
public:
    /// What the program is built from.
    static constexpr std::array parts{"CMakeLists.txt", "CMakePresets.json", "cmake",       "base",
                                      "scene",          "techniques",        "groundtruth", "harness"};

    /// Copies what the program is built from: files that differ, so that only those are built again. A fault left by a
    /// killed run is thus gone. Throws Inconclusive without git.
    TreeCopy(std::filesystem::path source, std::filesystem::path folder);

    /// Hash of the copied files but for those that only judge records (harness/gate): with one hash, one program's records.
    [[nodiscard]] const std::string& hash() const { return hash_; }

    [[nodiscard]] std::string read(const std::filesystem::path& file) const;
    void write(const std::filesystem::path& file, std::string_view text) const;

    /// Builds the program; throws InternalError with what the compiler said first.
    void build() const;
    [[nodiscard]] std::filesystem::path program() const { return folder_ / "build/release/shadowbench"; }

private:
    [[nodiscard]] std::vector<std::string> trackedFiles() const;
    void removeAllBut(const std::vector<std::string>& files) const;

    std::filesystem::path source_, folder_;
    std::string hash_;
};

/// A fault that is in the copy for as long as the object lives.
class PlantedFault {
public:
    PlantedFault(const TreeCopy& tree, std::filesystem::path file, std::string_view text);
    ~PlantedFault();
    PlantedFault(const PlantedFault&) = delete;
    PlantedFault& operator=(const PlantedFault&) = delete;

private:
    const TreeCopy& tree_;
    std::filesystem::path file_;
    std::string original_;
};

} // namespace shadowbench::mutants
