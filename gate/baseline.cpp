#include "gate/baseline.h"

#include "base/error.h"
#include "base/files.h"
#include "base/folder_lock.h"
#include "base/git.h"
#include "base/hash.h"
#include "base/pattern.h"
#include "base/process.h"
#include "base/temporary_folder.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <unistd.h>
#include <vector>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours longestBuild{2};

bool isProgram(const fs::path& file) { return fs::is_regular_file(file) && access(file.c_str(), X_OK) == 0; }

/// What is at a path; nothing if that is neither program nor records.
std::optional<Baseline> baselineAt(const fs::path& place, const std::string& name) {
    if (isProgram(place)) return Baseline{Baseline::Kind::Program, place, name};
    if (fs::is_regular_file(place)) return Baseline{Baseline::Kind::Records, place, name};
    if (isProgram(place / "shadowbench")) return Baseline{Baseline::Kind::Program, place / "shadowbench", name};
    if (fs::is_regular_file(place / "results.jsonl"))
        return Baseline{Baseline::Kind::Records, place / "results.jsonl", name};
    return std::nullopt;
}

fs::path required(const char* tool) {
    if (const auto program = findProgram(tool)) return *program;
    throw Inconclusive(
        fmt::format("building the base needs {}, which is not installed; install it with: apt-get install {}", tool, tool));
}

/// What tells compilers apart, hashed: a base that another one built would show its code as the head's change.
std::string compilerHash() {
    std::string said;
    const TemporaryFolder folder;
    Command command{required("c++"), {"--version"}, folder.path()};
    runProcess(command, [&](std::string_view line) { said += std::string(line) + "\n"; });
    return hash128(said).text().substr(0, 12);
}

/// Where ccache keeps what it knows, for a build whose HOME is a scratch folder.
std::string compilerCache() {
    if (const char* folder = std::getenv("CCACHE_DIR")) return folder;
    const char* home = std::getenv("HOME");
    return (fs::path(home != nullptr ? home : "/root") / ".cache" / "ccache").string();
}

class Build {
public:
    Build(fs::path repository, std::string commit, const Progress& progress)
        : repository_(std::move(repository)), commit_(std::move(commit)), progress_(progress) {}

    void configure() {
        step("git",
             {"-c", "safe.directory=*", "clone", "-q", "--shared", "--no-checkout", repository_.string(), source_.string()});
        step("git", {"-c", "safe.directory=*", "-C", source_.string(), "checkout", "-q", "--detach", commit_});
        step("cmake", {"-S", source_.string(), "-B", build_.string(), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                       "-DSHADOWBENCH_TESTS=OFF", "-DSHADOWBENCH_BENCHMARKS=OFF"});
    }

    /// The hash of what would be built, as it would say itself; "" of commits from before there was one.
    std::string program() {
        try {
            step("cmake", {"--build", build_.string(), "--target", "commit"});
        } catch (const Inconclusive&) {
            return "";
        }
        const fs::path header = build_ / "embedded" / "embedded_commit.h";
        const std::string text = fs::exists(header) ? readFile(header) : "";
        const std::vector<std::string> found = firstMatch(text, "program = \"([0-9a-f]+)\"");
        return found.empty() ? "" : found[1];
    }

    /// Leaves the built program in `file`.
    void into(const fs::path& file) {
        step("cmake",
             {"-E", "env", "CCACHE_DIR=" + compilerCache(), "CCACHE_NOHASHDIR=1", "CCACHE_SLOPPINESS=locale",
              "CCACHE_BASEDIR=" + source_.string(), "cmake", "--build", build_.string(), "--target", "shadowbench"});
        writeFileWith(file, [&](const fs::path& path) { // with the permissions of what is copied
            fs::copy_file(build_ / "shadowbench", path, fs::copy_options::overwrite_existing);
        });
    }

private:
    void step(const char* tool, std::vector<std::string> arguments) {
        Command command{required(tool), std::move(arguments), folder_.path()};
        command.limit = longestBuild;
        command.cpuLimit = longestBuild;
        command.fileLimit = std::uintmax_t{1} << 30U;
        command.memoryLimit = std::uintmax_t{16} << 30U;
        std::vector<std::string> said;
        const Finished finished = runProcess(command, [&](std::string_view line) {
            progress_(0, line);
            said.emplace_back(line);
            if (said.size() > 20) said.erase(said.begin());
        });
        if (finished.exitCode != 0 || finished.signal != 0) // of the latter kind is the end of what takes too long
            throw Inconclusive(fmt::format("building the base, commit {}, failed:\n{}", commit_, fmt::join(said, "\n")));
    }

    fs::path repository_;
    std::string commit_;
    const Progress& progress_;
    TemporaryFolder folder_;
    // Where `bench` builds, seen from the source: the compiler cache then knows what the head's build has compiled.
    fs::path source_ = folder_.path() / "source", build_ = source_ / "build" / "release";
};

} // namespace

Baseline findBaseline(const std::string& text, const fs::path& cache, const std::string& headsProgram,
                      const Progress& progress) {
    if (text.empty())
        throw Inconclusive(
            "the gate has nothing to compare with; name a build folder, a git revision or records with --base");
    const fs::path here = fs::current_path();
    const std::string repository = firstLine(git(here, {"rev-parse", "--show-toplevel"}));
    const std::string commit = firstLine(git(here, {"rev-parse", "--verify", "--quiet", text + "^{commit}"}));
    const bool isRevision = !repository.empty() && !commit.empty();
    if (const auto base = baselineAt(text, text)) {
        if (isRevision)
            throw BadInput(fmt::format("the base \"{0}\" is a git revision and a path here; for the path say ./{0}", text));
        return *base;
    }
    if (!isRevision) {
        const bool shallow = firstLine(git(here, {"rev-parse", "--is-shallow-repository"})) == "true";
        throw Inconclusive(
            fmt::format("the base \"{}\" is no build folder, no records and no git revision here; {}", text,
                        shallow ? "this clone is shallow: fetch the whole history (git fetch --unshallow, fetch-depth: 0)"
                                : "name one of them with --base"));
    }
    const std::string name = fmt::format("{} ({})", text, commit.substr(0, 12));
    const fs::path program = fs::absolute(cache) / "programs" / (commit + "-" + compilerHash()) / "shadowbench";
    if (!isProgram(program)) {
        const FolderLock alone(program.parent_path(), [&] { progress(0, "waiting for another gate that builds it"); });
        if (!isProgram(program)) {
            Build build(repository, commit, progress);
            build.configure();
            if (!headsProgram.empty() && build.program() == headsProgram)
                return {Baseline::Kind::HeadsProgram, {}, name, commit};
            build.into(program);
        }
    }
    return {Baseline::Kind::Program, program, name};
}

} // namespace shadowbench::gate
