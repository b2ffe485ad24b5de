// Numbers, texts and files between a process and the child that reads for it, where calls fail or are interrupted.
#include "base/confined/wire.h"

#include "base/confined/passed_descriptors.h"
#include "base/confined/reader.h"
#include "base/files.h"
#include "base/interrupts.h"
#include "base/temporary_folder.h"
#include "tests/support/failing_call.h"
#include "tests/support/message_of.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <sys/socket.h>
#include <sys/time.h>
#include <thread>
#include <unistd.h>

namespace shadowbench {
namespace {

using std::chrono::milliseconds;
using test::saidByACopy;

std::string refusal(const std::function<void()>& work) { return test::messageOf<WireError>(work); }

TEST(Wire, WithoutAnybodyAtItsOtherEndSaysSo) {
    const std::string closed = "the other end has closed";
    auto [ours, theirs] = makeSockets();
    Wire wire(std::move(ours));
    theirs.close();
    wire.put(std::string(100, 'x')); // whoever receives notices
    EXPECT_EQ(refusal([&] { wire.number(1, "as a number"); }), closed);
    EXPECT_EQ(refusal([&] { wire.takeHanded(); }), closed);
    Wire none(Descriptor(-1));
    EXPECT_EQ(refusal([&] { none.number(1, "as a number"); }), closed);
    EXPECT_EQ(refusal([&] { none.takeHanded(); }), closed);
    EXPECT_FALSE(passDescriptors(-1, 0, {}));
}

TEST(Wire, WaitsNoLongerThanItsDeadline) {
    const auto [ours, theirs] = makeSockets();
    const auto begin = std::chrono::steady_clock::now();
    Wire wire(Descriptor(::dup(ours.get())), begin + milliseconds(20));
    EXPECT_EQ(refusal([&] { wire.number(1, "as a number"); }), "nothing came in time");
    EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(19));
}

TEST(Wire, AChildThatIsWaitedForWhenTheUserInterruptsIsGivenUp) {
    EXPECT_EQ(saidByACopy([] {
                  auto [ours, theirs] = makeSockets();
                  ReaderChild child("cannot read a.png", std::move(ours));
                  static const DeferredInterrupts deferred; // which ends this process when it goes
                  std::raise(SIGTERM);
                  child.ask(0);
                  child.awaitAnswer();
                  return std::string("it answered");
              }),
              "cannot read a.png: the run was interrupted");
}

/// In a copy of this process, a signal that is handled comes every millisecond, and calls that wait are not started again.
std::string saidUnderSignals(const std::function<std::string()>& work) {
    return saidByACopy([&] {
        struct sigaction handled {};
        handled.sa_handler = [](int) {};
        ::sigaction(SIGALRM, &handled, nullptr);
        const itimerval often{{0, 1000}, {0, 1000}};
        ::setitimer(ITIMER_REAL, &often, nullptr);
        std::string said = work();
        ::setitimer(ITIMER_REAL, nullptr, nullptr);
        return said;
    });
}

/// Signals go to the thread that waits, and to no other.
std::thread later(const std::function<void()>& work) {
    return std::thread([work] {
        sigset_t alarm;
        sigemptyset(&alarm);
        sigaddset(&alarm, SIGALRM);
        ::pthread_sigmask(SIG_BLOCK, &alarm, nullptr);
        std::this_thread::sleep_for(milliseconds(30));
        work();
    });
}

TEST(Wire, ReceivesAndSendsWholeUnderSignals) {
    EXPECT_EQ(saidUnderSignals([] {
                  auto [ours, theirs] = makeSockets();
                  Wire here(std::move(ours)), there(std::move(theirs));
                  std::thread sender = later([&] { there.put(std::string(100, 'x')); });
                  std::string said = here.text(1000);
                  sender.join();
                  return said;
              }),
              std::string(100, 'x'));
    EXPECT_EQ(saidUnderSignals([] {
                  constexpr std::size_t size = 8 << 20; // more than a socket holds
                  auto [ours, theirs] = makeSockets();
                  Wire here(std::move(ours)), there(std::move(theirs));
                  std::string received;
                  std::thread receiver = later([&] { received = there.text(size); });
                  here.put(std::string(size, 'x'));
                  receiver.join();
                  return std::to_string(received.size());
              }),
              std::to_string(8 << 20));
}

TEST(Wire, HandsFilesOverUnderSignals) {
    EXPECT_EQ(saidUnderSignals([] {
                  const auto [ours, theirs] = makeSockets();
                  std::thread sender = later([end = ours.get()] { passDescriptors(end, 7, std::array{STDERR_FILENO}); });
                  const auto taken = takeDescriptors(theirs.get());
                  sender.join();
                  return taken ? std::to_string(taken->first) + ", " + std::to_string(taken->second.size()) : "nothing";
              }),
              "7, 1");
    EXPECT_EQ(saidUnderSignals([] {
                  const auto [ours, theirs] = makeSockets();
                  std::string filling(1 << 16, 'x');
                  std::size_t filled = 0; // until it would wait
                  for (ssize_t sent = 0;
                       (sent = ::send(ours.get(), filling.data(), filling.size(), MSG_DONTWAIT | MSG_NOSIGNAL)) > 0;)
                      filled += static_cast<std::size_t>(sent);
                  std::thread receiver = later([&filling, &filled, end = theirs.get()] {
                      for (std::size_t left = filled; left > 0;)
                          left -= static_cast<std::size_t>(::recv(end, filling.data(), std::min(left, filling.size()), 0));
                  });
                  const bool passed = passDescriptors(ours.get(), 7, std::array{STDERR_FILENO});
                  receiver.join();
                  const auto taken = takeDescriptors(theirs.get());
                  return std::string(passed && taken && taken->second.size() == 1 ? "passed" : "lost");
              }),
              "passed");
}

TEST(Wire, TakesNoFileFromAMessageThatCarriesSomethingElse) {
    const auto [ours, theirs] = makeSockets();
    const int on = 1; // the kernel adds who sent it
    ASSERT_EQ(::setsockopt(theirs.get(), SOL_SOCKET, SO_PASSCRED, &on, sizeof on), 0);
    ASSERT_TRUE(passDescriptors(ours.get(), 7, {}));
    const auto taken = takeDescriptors(theirs.get());
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->first, 7U);
    EXPECT_TRUE(taken->second.empty());
}

TEST(OpenedFile, ThatCannotBeReadIsNamed) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "a.bin", "bytes");
    const auto read = [&] { return contentOf(openBelow(folder.path(), "a.bin")); };
    EXPECT_EQ(test::saidWhere({SCMP_SYS(pread64), EIO}, read), "cannot read a.bin: Input/output error");
    EXPECT_EQ(test::saidWhere({SCMP_SYS(newfstatat), EIO}, read),
              "cannot read " + (folder.path() / "a.bin").string() + ": Input/output error");
    EXPECT_EQ(saidByACopy([&] { return contentOf(openBelow(folder.path() / "none", "a.bin")); }),
              "cannot read " + (folder.path() / "none").string() + ": No such file or directory");
    EXPECT_EQ(saidByACopy([&] {
                  std::filesystem::current_path(folder.path());
                  return contentOf(openBelow("", "a.bin"));
              }),
              "bytes");
}

} // namespace
} // namespace shadowbench
