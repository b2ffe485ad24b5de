// Runs the built program as a user does.
#pragma once

#include "base/temporary_folder.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <sys/wait.h>

namespace shadowbench {

struct Outcome {
    int code = -1;      // exit status, or 128 + signal
    std::string output; // stdout and stderr together
};

/// Runs a shell command line in which `shadowbench` stands for the program under test.
inline Outcome shell(std::string command) {
    for (std::size_t at = command.find("shadowbench "); at != std::string::npos; at = command.find("shadowbench ", at + 1)) {
        if (at > 0 && command[at - 1] != ' ') continue;
        command.replace(at, 11, PROGRAM);
        at += std::string(PROGRAM).size();
    }
    Outcome outcome;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) outcome.output += buffer.data();
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

/// A fresh folder that goes away with the object.
class Folder {
public:
    [[nodiscard]] std::string operator/(const std::string& name) const { return (folder_.path() / name).string(); }

    /// A cache of its own, but for truths and the machine code of shaders: those lie with what other tests have computed.
    /// Tests of the cache itself, and of what is said while truths are computed, take an empty folder.
    [[nodiscard]] std::string cache() const {
        namespace fs = std::filesystem;
        const fs::path own = folder_.path() / "cache", shared = fs::temp_directory_path();
        const auto link = [&](const std::string& name, const fs::path& to) {
            fs::create_directories(to);
            if (!fs::is_symlink(own / name)) fs::create_directory_symlink(to, own / name);
        };
        fs::create_directories(own);
        link("shaders", shared / "shadowbench-test-shaders");
        constexpr std::string_view digits = "0123456789abcdef"; // of the folders of a cache (groundtruth/store/cache.cpp)
        for (const char high : digits)
            for (const char low : digits) link({high, low}, shared / "shadowbench-test-references" / std::string{high, low});
        return own.string();
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / name) << text;
        return *this / name;
    }

private:
    TemporaryFolder folder_;
};

/// A scene that is rendered and scored in a second. `extra` is appended.
inline std::string tinyScene(const std::string& light = "{ kind = \"point\", centre = [1.7, 6.1, -2.3] }",
                             const std::string& extra = "") {
    return "# A box over a slab.\ntitle = \"Tiny\"\nsize = [48, 48]\nreference_samples = 64\n"
           "camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }\nlight = " +
           light +
           "\n[timeline]\nstill = 3\nmoving = 1\n[[object]]\nmesh = { box = { size = [12, 0.2, 12] } }\nplace = [{ at = [0, "
           "-0.1, 0] }]\n"
           "[[object]]\nmesh = { box = { size = [1.6, 0.4, 1.2] } }\nplace = [{ at = [0.13, 1.2, 0.21] }]\n" +
           extra;
}

/// The tiny scene with two balls of two levels and a camera that moves through their transition in five frames.
inline std::string walkScene() {
    return tinyScene(
        "{ kind = \"point\", centre = [1.7, 6.1, -2.3] }",
        "[[object]]\nmesh = { sphere = { radius = 0.5 } }\nlod = { triangles = [500, 80], until = [8] }\n"
        "place = [{ at = [1.5, 0.45, 1.5] }, { at = [-1.5, 0.45, -1.5] }]\n"
        "[lod]\nframes = 5\nband = 0.5\npath = [{ frame = 0, shift = [0, 0, 0] }, { frame = 4, shift = [0, 0, -1] }]\n");
}

} // namespace shadowbench
