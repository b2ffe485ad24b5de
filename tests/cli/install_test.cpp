// The installed program, its manual page and its completion, and the Debian package.
#include "base/files.h"
#include "techniques/catalog.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

const std::string buildFolder = fs::path(PROGRAM).parent_path();

class Install : public testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(buildFolder + "/documents"); // a build of the program alone has made none
        const Outcome install = shell("cmake --install " + buildFolder + " --prefix " + prefix_ / "");
        ASSERT_EQ(install.code, 0) << install.output;
    }

    /// What bash offers for a command line whose last word is being typed; none may hold a quote.
    [[nodiscard]] std::string completions(const std::string& line) const {
        const std::string script = prefix_.write(
            "complete.bash", "PATH=" + prefix_ / "bin:$PATH" + "\nsource " + prefix_ / completion + "\nCOMP_WORDS=(" + line +
                                 ")\n[[ '" + line +
                                 "' == *' ' ]] && COMP_WORDS+=('')\n"
                                 "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_shadowbench\necho \"${COMPREPLY[*]}\"\n");
        return shell("bash --norc " + script).output;
    }

    static constexpr const char* completion = "share/bash-completion/completions/shadowbench";
    Folder prefix_;
};

TEST_F(Install, TheProgramRunsThereAndNamesItsVersionOnce) {
    const Outcome version = shell(prefix_ / "bin/shadowbench" + " --version");
    EXPECT_EQ(version.code, 0) << version.output;
    const std::string project = readFile(std::string(SOURCE_FOLDER) + "/CMakeLists.txt");
    const std::size_t at = project.find("project(shadowbench VERSION ") + std::string("project(shadowbench VERSION ").size();
    EXPECT_TRUE(version.output.starts_with("shadowbench " + project.substr(at, project.find(' ', at) - at) + " (commit "))
        << version.output;
    EXPECT_EQ(shell(prefix_ / "bin/shadowbench" + " list scenes --format ids").code, 0);
}

TEST_F(Install, TheManualPageRendersEveryVerbWithItsOptions) {
    const Outcome page = shell("MANWIDTH=120 man --warnings -l " + prefix_ / "share/man/man1/shadowbench.1" + " | col -b");
    ASSERT_EQ(page.code, 0) << page.output;
    EXPECT_EQ(page.output.find("warning:"), std::string::npos) << page.output;
    for (const char* text : {"shadowbench - ", "\n   run\n", "\n   cache list\n", "--technique TEXT", "EXIT STATUS",
                             "shadowbench run --scene dueling-frusta"})
        EXPECT_NE(page.output.find(text), std::string::npos) << text;
    EXPECT_EQ(page.output.find("count-frames"), std::string::npos); // hidden verbs
}

TEST_F(Install, BashCompletesVerbsOptionsAndValues) {
    EXPECT_EQ(completions("shadowbench rep"), "report\n");
    EXPECT_EQ(completions("shadowbench cache ver"), "verify\n");
    EXPECT_EQ(completions("shadowbench list met"), "metrics\n");
    EXPECT_EQ(completions("shadowbench run --tech"), "--technique --technique-folder\n");
    EXPECT_EQ(completions("shadowbench run --profile "), "gate standard paper\n");
    EXPECT_EQ(completions("shadowbench run --scene duel"), "dueling-frusta\n");
    EXPECT_EQ(completions("shadowbench run --out "), "\n"); // files, which bash knows itself
    std::string ids;
    for (const techniques::Entry& entry : techniques::catalog()) ids += (ids.empty() ? "" : " ") + entry.id;
    EXPECT_EQ(completions("shadowbench sweep --technique "), ids + "\n");
}

TEST_F(Install, TheDebianPackageHoldsTheSameAndNamesWhatItNeeds) {
    const Outcome package = shell("cd " + buildFolder + " && cpack -G DEB -B " + prefix_ / "package");
    ASSERT_EQ(package.code, 0) << package.output;
    const std::string file = prefix_ / "package/shadowbench_*.deb";
    const Outcome depends = shell("dpkg-deb -f " + file + " Depends Recommends");
    for (const char* name : {"libosmesa6", "libopenexr", "povray", "gnuplot-nox", "Recommends: valgrind"})
        EXPECT_NE(depends.output.find(name), std::string::npos) << name << " is not in " << depends.output;
    ASSERT_EQ(shell("dpkg-deb -x " + file + " " + prefix_ / "root").code, 0);
    for (const char* path :
         {"bin/shadowbench", "share/man/man1/shadowbench.1", completion, "share/zsh/vendor-completions/_shadowbench",
          "share/doc/shadowbench/docs/score.md", "share/doc/shadowbench/examples/scenes/simple.toml",
          "share/doc/shadowbench/examples/clients/threejs/render"})
        EXPECT_TRUE(fs::exists(prefix_ / "root/usr" + ("/" + std::string(path)))) << path;
    const std::string notices = readFile(prefix_ / "root/usr/share/doc/shadowbench/copyright");
    for (const char* words : {"GPL-3.0-or-later", "Mike Bostock", "Niels Lohmann", "University of Cincinnati"})
        EXPECT_NE(notices.find(words), std::string::npos) << words;
    // What Debian runs of an installed package.
    const std::string root = prefix_ / "root/usr";
    const Outcome firstRun = shell("export PATH=" + root + "/bin:$PATH DOCUMENTS=" + root + "/share/doc/shadowbench" +
                                   " AUTOPKGTEST_TMP=" + prefix_ / "" + " SHADOWBENCH_CACHE=" + prefix_.cache() + "; sh " +
                                   SOURCE_FOLDER + "/debian/tests/first-run");
    EXPECT_EQ(firstRun.code, 0) << firstRun.output;
}

} // namespace
} // namespace shadowbench
