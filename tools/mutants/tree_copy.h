// A copy of the tracked source files in a folder of its own, in which faults are planted and built.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::mutants {

class TreeCopy {
public:
    /// Copies the tracked files: those that differ, so that only those are built again. A fault left by a
    /// killed run is thus gone. Throws Inconclusive without git.
    TreeCopy(std::filesystem::path source, std::filesystem::path folder);

    /// The copied files, sorted paths from the root.
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::string read(const std::filesystem::path& file) const;
    void write(const std::filesystem::path& file, std::string_view text) const;

    /// Builds a target of the build; throws InternalError with what the compiler said first.
    void build(const std::string& target) const;
    [[nodiscard]] std::filesystem::path program() const { return folder_ / "build/release/shadowbench"; }

private:
    [[nodiscard]] std::vector<std::string> trackedFiles() const;
    void removeAllBut(const std::vector<std::string>& files) const;

    std::filesystem::path source_, folder_;
    std::vector<std::string> files_;
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
