// A library that other people's bytes have taken over can do nothing but compute: each attempt is made by a reader with a
// planted overflow, in a real child.
#include "base/confined/reader.h"
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <seccomp.h>
#include <set>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

// ---- what an attacker would do
// --------------------------------------------------------------------------------------------------

/// What the request of a planted reader says: where its targets are.
std::string target;

int failedOrZero(long result) { return result < 0 ? errno : 0; }

int writeAnotherFile() { return failedOrZero(::open(target.c_str(), O_WRONLY | O_TRUNC)); }
int makeAFile() { return failedOrZero(::open((target + ".new").c_str(), O_WRONLY | O_CREAT, 0600)); }
int removeAFile() { return failedOrZero(::unlink(target.c_str())); }
int renameAFile() { return failedOrZero(::rename(target.c_str(), (target + ".moved").c_str())); }
int makeAFolder() { return failedOrZero(::mkdir((target + ".folder").c_str(), 0700)); }
int cutAFile() { return failedOrZero(::truncate(target.c_str(), 0)); }
int changeItsMode() { return failedOrZero(::chmod(target.c_str(), 0777)); }
int readAnotherFile() { return failedOrZero(::open(target.c_str(), O_RDONLY)); }
int readThePasswords() { return failedOrZero(::open("/etc/passwd", O_RDONLY)); }
int lookAtAFile() {
    struct stat status {};
    return failedOrZero(::stat(target.c_str(), &status));
}
int startAProgram() {
    const std::string script = "echo taken > " + target + ".new";
    const std::array<const char*, 4> words{"/bin/sh", "-c", script.c_str(), nullptr};
    return failedOrZero(::execve("/bin/sh", const_cast<char* const*>(words.data()), environ));
}
int startAProcess() {
    const pid_t child = ::fork();
    if (child == 0) _exit(0);
    return failedOrZero(child);
}
int connectSomewhere() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    if (socket < 0) return errno;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(9);
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    return failedOrZero(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address));
}
int killTheParent() { return failedOrZero(::kill(::getppid(), SIGUSR1)); }
int traceTheParent() { return failedOrZero(::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr)); }
int runItsOwnCode() {
    void* page = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return page == MAP_FAILED ? errno : 0;
}
int raiseALimit() {
    const rlimit more{64, 64};
    return failedOrZero(::setrlimit(RLIMIT_NOFILE, &more));
}

struct Attempt {
    const char* name;
    int (*make)(); // errno, or 0 where it succeeded
};

constexpr std::array<Attempt, 17> attempts{{{"WriteAnotherFile", writeAnotherFile},
                                            {"MakeAFile", makeAFile},
                                            {"RemoveAFile", removeAFile},
                                            {"RenameAFile", renameAFile},
                                            {"MakeAFolder", makeAFolder},
                                            {"CutAFile", cutAFile},
                                            {"ChangeItsMode", changeItsMode},
                                            {"ReadAnotherFile", readAnotherFile},
                                            {"ReadThePasswords", readThePasswords},
                                            {"LookAtAFile", lookAtAFile},
                                            {"StartAProgram", startAProgram},
                                            {"StartAProcess", startAProcess},
                                            {"ConnectSomewhere", connectSomewhere},
                                            {"KillTheParent", killTheParent},
                                            {"TraceTheParent", traceTheParent},
                                            {"RunItsOwnCode", runItsOwnCode},
                                            {"RaiseALimit", raiseALimit}}};

/// A reader of a format whose name has 16 letters, and which believes the file when it has more: what follows lands on the
/// function that is called next.
void readWithOverflow(ForeignWork& work) {
    struct {
        std::array<char, 16> name{};
        std::uint64_t next = ~std::uint64_t{0};
    } format;
    target = work.request();
    const std::string bytes = contentOf(work.files().front());
    const volatile char* from = bytes.data();
    auto* to = reinterpret_cast<volatile char*>(&format);
    for (std::size_t i = 0; i < std::min(bytes.size(), sizeof format); ++i) to[i] = from[i];
    const int failed = format.next < attempts.size() ? attempts.at(format.next).make() : -1;
    work.answer().put(static_cast<std::uint64_t>(failed == -1 ? 1000 : failed));
}

const ForeignReader overflowing("overflowing", readWithOverflow);
const ForeignReader unfiltered("unfiltered", readWithOverflow); // whose server inherits that filters are forbidden

std::string exploitOf(std::uint64_t attempt) {
    std::string bytes(24, 'A');
    std::memcpy(bytes.data() + 16, &attempt, sizeof attempt);
    return bytes;
}

std::vector<OpenedFile> only(const fs::path& file) {
    std::vector<OpenedFile> files;
    files.push_back(openRegular(file));
    return files;
}

class PlantedOverflow : public testing::Test {
protected:
    /// errno of the attempt, 0 where it succeeded, or −1 where the child was ended for it.
    int outcome(const std::string& bytes, const ForeignReader& reader = overflowing) {
        writeFile(folder_.path() / "exploit", bytes);
        try {
            ReaderChild child(reader, "cannot read exploit", only(folder_.path() / "exploit"), victim_.string());
            protections_ = child.protections();
            child.awaitAnswer();
            return static_cast<int>(child.number(1000, "as errno"));
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find("cannot read exploit: its reader was stopped at a system call"),
                      std::string::npos)
                << error.what();
            return -1;
        }
    }

    std::set<std::string> filesThere() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(victim_.parent_path())) names.insert(entry.path().filename());
        return names;
    }

    TemporaryFolder folder_, home_;
    const fs::path victim_ = home_.path() / "victim";
    Protections protections_;
};

class TakenOver : public PlantedOverflow, public testing::WithParamInterface<std::size_t> {};

constexpr const char* unfilteredBuild = "sanitizers make system calls of their own, so nothing filters them";

TEST_P(TakenOver, DoesNotGetThrough) {
    if (hasSanitizer()) GTEST_SKIP() << unfilteredBuild;
    writeFile(victim_, "kept");
    const fs::perms mode = fs::status(victim_).permissions();
    const int failed = outcome(exploitOf(GetParam()));
    EXPECT_NE(failed, 0) << attempts.at(GetParam()).name << " succeeded, in a child with " << protections_.inWords();
    EXPECT_EQ(readFile(victim_), "kept");
    EXPECT_EQ(fs::status(victim_).permissions(), mode);
    EXPECT_EQ(filesThere(), std::set<std::string>{"victim"});
}

std::string nameOf(const testing::TestParamInfo<std::size_t>& info) { return attempts.at(info.param).name; }

INSTANTIATE_TEST_SUITE_P(Attempts, TakenOver, testing::Range(std::size_t{0}, attempts.size()), nameOf);

/// So that the attempts above are not refused for a fault of their own.
TEST(Attempts, SucceedInAProcessThatIsNotConfined) {
    const TemporaryFolder folder;
    target = folder.path() / "victim";
    writeFile(target, "kept");
    for (const Attempt& attempt : attempts) {
        const std::set<std::string> others{"KillTheParent", "TraceTheParent", "StartAProgram", "ConnectSomewhere",
                                           "RemoveAFile",   "RenameAFile",    "RaiseALimit"};
        if (others.contains(attempt.name)) continue;
        EXPECT_EQ(attempt.make(), 0) << attempt.name;
    }
    EXPECT_EQ(readFile(target), "");
    EXPECT_EQ(renameAFile(), 0);
}

/// Both compilers' sanitizers; a limit of memory would end their programs at once.
TEST(Sanitizer, IsKnownWhicheverCompilerLinkedIt) {
    const bool linked = ::dlsym(RTLD_DEFAULT, "__asan_init") != nullptr || ::dlsym(RTLD_DEFAULT, "__tsan_init") != nullptr;
    EXPECT_EQ(hasSanitizer(), linked);
}

using Confinement = PlantedOverflow;

TEST_F(Confinement, OfAFileThatFitsIsNotNoticed) {
    writeFile(victim_, "kept");
    EXPECT_EQ(outcome("an honest name"), 1000);
}

TEST_F(Confinement, SaysWhatHolds) {
    EXPECT_EQ((Protections{true, 6}).inWords(), "limits, a filter of system calls (seccomp), Landlock 6");
    EXPECT_EQ((Protections{}).inWords(), "limits");
    const Protections packed = Protections::unpacked((Protections{true, 7}).packed());
    EXPECT_TRUE(packed.systemCalls);
    EXPECT_EQ(packed.landlock, 7);
    EXPECT_EQ(protectionsHere().systemCalls, !hasSanitizer());
}

/// Forbids this process further filters, as some containers do.
void forbidFilters() {
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(seccomp), 0);
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(landlock_create_ruleset), 0);
    const scmp_arg_cmp filterByPrctl{0, SCMP_CMP_EQ, PR_SET_SECCOMP, 0};
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1, filterByPrctl);
    if (seccomp_load(filter) != 0) _exit(77);
    seccomp_release(filter);
}

/// Limits alone keep a process from opening, which is more than nothing.
TEST_F(Confinement, WithoutSeccompAndLandlockWarnsOnceAndStillReads) {
    if (hasSanitizer()) GTEST_SKIP() << unfilteredBuild;
    writeFile(victim_, "kept");
    testing::internal::CaptureStderr();
    const pid_t child = ::fork();
    if (child == 0) {
        forbidFilters();
        const bool reads = outcome("an honest name", unfiltered) == 1000 && outcome("an honest name", unfiltered) == 1000;
        const bool opens = outcome(exploitOf(7), unfiltered) == 0; // readAnotherFile
        std::fflush(nullptr);
        _exit(reads ? (opens ? 2 : 0) : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said,
              "shadowbench: warning: this system filters no system calls (seccomp); foreign files are read with limits\n");
}

} // namespace
} // namespace shadowbench
