// What a foreign file names is a file below its folder, or nothing.
#include "base/confined/opened_files.h"
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Opened : public testing::Test {
protected:
    Opened() {
        writeFile(root_ / "secret", "secret");
        writeFile(folder_ / "a.bin", "bytes");
        writeFile(folder_ / "inner/b.bin", "more");
        fs::create_symlink("../secret", folder_ / "link");
        fs::create_directory_symlink("..", folder_ / "up");
    }
    [[nodiscard]] std::string refusal(const std::string& name) const {
        try {
            openBelow(folder_, name);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    }
    void expectRefusal(const std::string& name, const std::string& why) const {
        EXPECT_NE(refusal(name).find(why), std::string::npos) << name << ": " << refusal(name);
    }

    const TemporaryFolder temporary_;
    const fs::path root_ = temporary_.path(), folder_ = root_ / "scene";
};

TEST_F(Opened, FilesBelowAFolderAreReadWhole) {
    EXPECT_EQ(contentOf(openBelow(folder_, "a.bin")), "bytes");
    EXPECT_EQ(contentOf(openBelow(folder_, "./inner/b.bin")), "more");
    EXPECT_EQ(contentOf(openRegular(folder_ / "link")), "secret") << "a person's own choice";
}

TEST_F(Opened, NothingLeadsOutOfTheFolder) {
    expectRefusal("../secret", "without \"..\"");
    expectRefusal("inner/../../secret", "without \"..\"");
    expectRefusal((root_ / "secret").string(), "is no relative path");
    expectRefusal("", "is no relative path");
    expectRefusal(std::string("a.bin\0/x", 8), "control characters");
    expectRefusal("a\n\x1b[31m", "control characters");
    expectRefusal("link", "through a symbolic link");
    expectRefusal("up/secret", "through a symbolic link");
    expectRefusal("none", "No such file");
}

TEST_F(Opened, FoldersPipesAndDevicesAreNoFiles) {
    expectRefusal("inner", "it is a folder");
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    expectRefusal("pipe", "it is a pipe or a device");
    EXPECT_THROW(openRegular("/dev/zero"), BadInput);
    EXPECT_THROW(openRegular(folder_), BadInput);
}

TEST_F(Opened, FilesBeyondTheLimitAreNotRead) {
    writeFile(folder_ / "large", "");
    fs::resize_file(folder_ / "large", (1 << 20) + 1); // of holes
    EXPECT_NO_THROW(openBelow(folder_, "large"));
    ::setenv("SHADOWBENCH_MAX_FILE_MIB", "1", 1);
    expectRefusal("large", "it has 2 MiB, more than the 1 of SHADOWBENCH_MAX_FILE_MIB, which can be raised");
    ::unsetenv("SHADOWBENCH_MAX_FILE_MIB");
}

TEST_F(Opened, AFileThatBecomesShorterIsNotHalfRead) {
    const OpenedFile file = openRegular(folder_ / "a.bin");
    fs::resize_file(folder_ / "a.bin", 2);
    EXPECT_THROW(contentOf(file), BadInput);
}

} // namespace
} // namespace shadowbench
