// The list of layers (cmake/layers.txt) and the includes that it is held against.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::layers {

/// A line of the list: `folder: the folders it includes | the packages it links`.
struct Module {
    std::string folder;
    std::vector<std::string> arrows, packages;
};

/// An include of a file; paths are relative to the root of the tree. A header of a package has its own path.
struct Include {
    std::string file;
    int line = 0;
    std::string target;
    bool inBrackets = false;
};

/// Whose a header is by how its path begins. `<thread>` needs no line: every module reaches base, which links threads.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 20> packageOfHeader{
    {{"CGAL/", "cgal"},
     {"CLI/", "cli11"},
     {"EGL/", "gl"},
     {"GL/", "gl"},
     {"OpenEXR/", "openexr"},
     {"assimp/", "assimp"},
     {"boost/", "boost"},
     {"embree3/", "embree"},
     {"glslang/", "glslang"},
     {"httplib.h", "httplib"},
     {"meshoptimizer.h", "meshoptimizer"},
     {"mustache.hpp", "mustache"},
     {"nlohmann/", "json"},
     {"png.h", "png"},
     {"seccomp.h", "seccomp"},
     {"spirv-tools/", "glslang"},
     {"toml++/", "toml"},
     {"vulkan/", "vulkan"},
     {"xxhash.h", "xxhash"},
     {"zlib.h", "zlib"}}};

/// Libraries that every module links, the operating system's headers, and Valgrind's, which are macros only.
inline constexpr std::array<std::string_view, 5> headersOfAll{"fmt/", "glm/", "linux/", "sys/", "valgrind/"};

inline std::vector<std::string> wordsOf(const std::string& text) {
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

inline std::vector<Module> readList(const std::filesystem::path& file) {
    static const std::regex format(R"(([^:]+):([^|]*)(\|(.*))?)");
    std::vector<Module> modules;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (line.starts_with("#") || !std::regex_match(line, match, format)) continue;
        modules.push_back({match[1], wordsOf(match[2]), wordsOf(match[4])});
    }
    return modules;
}

/// The line that a file belongs to: that of the longest folder which holds it; nullptr without one.
inline const Module* moduleOf(const std::vector<Module>& modules, const std::string& file) {
    const Module* longest = nullptr;
    for (const Module& module : modules)
        if (file.starts_with(module.folder + "/") && (longest == nullptr || module.folder.size() > longest->folder.size()))
            longest = &module;
    return longest;
}

/// Empty for headers of the standard library and for those that every module may include.
inline std::string_view packageOf(std::string_view header) {
    const auto begins = [&](std::string_view start) { return header.starts_with(start); };
    const auto* const known = std::ranges::find_if(packageOfHeader, [&](const auto& entry) { return begins(entry.first); });
    if (known != packageOfHeader.end()) return known->second;
    const bool isOfAll = header.find('/') == std::string_view::npos || std::ranges::any_of(headersOfAll, begins);
    return isOfAll ? std::string_view() : "a package that tests/tree/layers.h does not know";
}

inline bool isShader(const std::filesystem::path& file) {
    const auto ending = file.extension();
    return ending == ".glsl" || ending == ".vert" || ending == ".frag" || ending == ".comp";
}

/// Shaders are named relative to techniques/, in their own includes and in the C++ that loads them; in a technique's folder
/// also by the names that they have there.
inline void addIncludes(const std::filesystem::path& root, const std::string& file, std::vector<Include>& includes) {
    static const std::regex directive(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
    static const std::regex loaded(R"re("([\w/.-]+\.(vert|frag|comp))")re");
    std::ifstream lines(root / file);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch match;
        if (line.find("include") != std::string::npos && std::regex_match(line, match, directive)) {
            if (match[2].str().starts_with("embedded_")) continue; // made by the build from the module's own files
            const std::string name = match[2].str(), beside = (std::filesystem::path(file).parent_path() / name).string();
            const bool isBeside = isShader(file) && std::filesystem::exists(root / beside);
            const std::string folder = isShader(file) ? "techniques/" : "";
            includes.push_back({file, number, isBeside ? beside : folder + name, match[1] == "<"});
        } else if (line.find('"') != std::string::npos && std::regex_search(line, match, loaded)) {
            includes.push_back({file, number, "techniques/" + match[1].str(), false});
        }
    }
}

/// The folders at the tree's root that hold modules.
inline std::set<std::string> roomsOf(const std::vector<Module>& modules) {
    std::set<std::string> rooms;
    for (const Module& module : modules) rooms.insert(module.folder.substr(0, module.folder.find('/')));
    return rooms;
}

/// Of all headers, sources and shaders of the modules' rooms.
inline std::vector<Include> includesOf(const std::filesystem::path& root, const std::vector<Module>& modules) {
    std::set<std::string> files;
    for (const std::string& folder : roomsOf(modules)) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const auto ending = entry.path().extension();
            if (ending == ".h" || ending == ".cpp" || isShader(entry.path()))
                files.insert(entry.path().lexically_relative(root).generic_string());
        }
    }
    std::vector<Include> includes;
    for (const std::string& file : files) addIncludes(root, file, includes);
    return includes;
}

/// What is wrong with the list itself. A line names only lines above it: no cycle is possible.
inline std::vector<std::string> faultsOfList(const std::vector<Module>& modules) {
    std::vector<std::string> faults;
    std::set<std::string> above;
    for (const Module& module : modules) {
        if (above.contains(module.folder)) faults.push_back(module.folder + " has two lines");
        for (const std::string& arrow : module.arrows)
            if (!above.contains(arrow))
                faults.push_back(fmt::format("the line of {} names {}, which has no line above it", module.folder, arrow));
        above.insert(module.folder);
    }
    return faults;
}

/// Includes that lead out of a module and into none that its line names.
inline std::vector<std::string> strayIncludes(const std::vector<Module>& modules, const std::vector<Include>& includes) {
    std::vector<std::string> strays;
    const auto names = [](const std::vector<std::string>& line, std::string_view word) {
        return std::ranges::find(line, word) != line.end();
    };
    for (const Include& include : includes) {
        const std::string place = fmt::format("{}:{}: {}", include.file, include.line, include.target);
        const Module* from = moduleOf(modules, include.file);
        if (from == nullptr) {
            strays.push_back(place + ": no line of the list holds this file");
            continue;
        }
        if (include.inBrackets) {
            const std::string_view package = packageOf(include.target);
            if (!package.empty() && !names(from->packages, package))
                strays.push_back(
                    fmt::format("{} is of {}, which the line of {} does not name", place, package, from->folder));
            continue;
        }
        const Module* to = moduleOf(modules, include.target);
        if (to != from && (to == nullptr || !names(from->arrows, to->folder)))
            strays.push_back(fmt::format("{} is of {}, which the line of {} does not name", place,
                                         to == nullptr ? "no module" : to->folder, from->folder));
    }
    return strays;
}

/// Headers of packages that each file includes, itself or through the headers that it includes.
class PackagesSeen {
public:
    explicit PackagesSeen(const std::vector<Include>& includes) {
        for (const Include& include : includes) of_[include.file].push_back(&include);
    }

    [[nodiscard]] std::set<std::string_view> by(const std::string& file) const {
        std::set<std::string> visited;
        std::set<std::string_view> packages;
        add(file, visited, packages);
        return packages;
    }

private:
    void add(const std::string& file, std::set<std::string>& visited, std::set<std::string_view>& packages) const {
        const auto found = of_.find(file);
        if (found == of_.end() || !visited.insert(file).second) return;
        for (const Include* include : found->second) {
            if (include->inBrackets)
                packages.insert(packageOf(include->target));
            else
                add(include->target, visited, packages);
        }
    }

    std::map<std::string, std::vector<const Include*>> of_;
};

/// Folders and packages that a line names and none of the module's files includes. Linking needs no others, as what is
/// called is declared in a header; of a module that includes a list of names (catalog.inc) this cannot be told.
inline std::vector<std::string> unusedArrows(const std::vector<Module>& modules, const std::vector<Include>& includes) {
    std::map<std::string, std::set<std::string_view>> used; // by folder
    std::set<std::string> unknown;
    const PackagesSeen seen(includes);
    for (const Include& include : includes) {
        const Module *from = moduleOf(modules, include.file), *to = moduleOf(modules, include.target);
        if (from == nullptr) continue;
        if (include.target.ends_with(".inc")) unknown.insert(from->folder);
        if (!include.inBrackets && to != nullptr) used[from->folder].insert(to->folder);
        used[from->folder].merge(seen.by(include.file));
    }
    std::vector<std::string> unused;
    for (const Module& module : modules) {
        if (unknown.contains(module.folder)) continue;
        const auto report = [&](const std::string& word) {
            if (word != "threads" && !used[module.folder].contains(word))
                unused.push_back(fmt::format("the line of {} names {}, of which it includes nothing", module.folder, word));
        };
        std::ranges::for_each(module.arrows, report);
        std::ranges::for_each(module.packages, report);
    }
    return unused;
}

} // namespace shadowbench::layers
