// What the tests of POV-Ray's failures share: a stand-in for the program and a temporary folder of their own.
#pragma once

#include "base/error.h"
#include "base/files.h"
#include "groundtruth/povray/povray.h"
#include "tests/support/povray_scene.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace shadowbench::groundtruth {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr glm::ivec2 size{64, 64};

/// Alive and not a zombie that nobody has collected yet.
inline bool alive(pid_t pid) {
    std::string stat;
    try {
        stat = readFile(fmt::format("/proc/{}/stat", pid));
    } catch (const Error&) {
        return false;
    }
    const std::size_t state = stat.rfind(')') + 2;
    return state < stat.size() && stat[state] != 'Z';
}

inline bool endsSoon(pid_t pid) {
    for (int i = 0; i < 200 && alive(pid); ++i) std::this_thread::sleep_for(10ms);
    return !alive(pid);
}

/// Temporary folders go to a place of the test's own, where whatever is left can be seen.
class PovRayStandIn : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "povray-test-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        base_ = name;
        fs::create_directory(temporary());
        if (const char* before = std::getenv("TMPDIR")) before_ = before;
        setenv("TMPDIR", temporary().c_str(), 1);
    }
    void TearDown() override {
        EXPECT_TRUE(fs::is_empty(temporary())) << "a temporary folder was left behind";
        before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1);
        fs::remove_all(base_);
    }

    [[nodiscard]] fs::path temporary() const { return base_ / "tmp"; }
    [[nodiscard]] fs::path file(const std::string& name) const { return base_ / name; }

    /// A stand-in for POV-Ray: a shell script with this body.
    povray::Options fake(const std::string& body, std::chrono::milliseconds limit = 30s) const {
        writeFile(file("povray"), "#!/bin/sh\n" + body + "\n");
        fs::permissions(file("povray"), fs::perms::owner_all);
        return {file("povray"), limit, 1};
    }

    /// The sentence with which rendering is inconclusive.
    static std::string sentence(const povray::Options& options, const Progress& progress = {}) {
        try {
            povray::render(overlappingPlates(), size, 16, options, progress);
        } catch (const Inconclusive& error) {
            return error.what();
        }
        ADD_FAILURE() << "rendering did not end as inconclusive";
        return "";
    }

    [[nodiscard]] pid_t pidIn(const std::string& name) const {
        for (int i = 0; i < 500 && !(fs::exists(file(name)) && fs::file_size(file(name)) > 0); ++i)
            std::this_thread::sleep_for(10ms);
        return std::stoi(readFile(file(name)));
    }

    fs::path base_;
    std::string before_;
};

inline bool contains(const std::string& text, std::string_view part) { return text.find(part) != text.npos; }

} // namespace shadowbench::groundtruth
