// Meshes and images are read by libraries, in a child that can reach nothing (base/confined/). Here it is a copy of this
// process: what counts is that it ends, and that this process is none the worse. How often one took its file, refused it or
// died is said at the end. And what a child that its file has taken over might answer, as this process reads it.
#include "base/confined/decoded_image.h"
#include "base/confined/image_reader.h"
#include "base/error.h"
#include "scene/meshes/foreign_mesh.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shadowbench::fuzz {
namespace {

constexpr int taken = 40, refused = 41; // exit codes that no sanitizer has

struct Counts {
    std::size_t taken = 0, refused = 0, died = 0;
    ~Counts() {
        if (std::getenv("SHADOWBENCH_FUZZ") != nullptr)
            fmt::print(stderr, "children: {} took their file, {} refused it, {} died\n", taken, refused, died);
    }
};

[[noreturn]] void readAndEnd(const std::function<void()>& read) {
    constexpr rlim_t seconds = 1;
    const rlimit time{seconds, seconds}, none{0, 0};
    ::setrlimit(RLIMIT_CPU, &time);
    ::setrlimit(RLIMIT_CORE, &none);
    ::setrlimit(RLIMIT_FSIZE, &none);
    if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(1);
    try {
        read();
    } catch (const std::exception&) {
        ::_exit(refused);
    }
    ::_exit(taken);
}

void readInAChild(const std::function<void()>& read) {
    static Counts counts;
    const pid_t child = ::fork();
    require(child >= 0, "no child can be started");
    if (child == 0) readAndEnd(read);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ++(code == taken ? counts.taken : code == refused ? counts.refused : counts.died);
    if (code == refused) throw BadInput("its reader refuses it");
    if (code != taken) throw BadInput("its reader has died");
}

void readMesh(const char* extension, std::string_view input) {
    readInAChild([&] { readMeshHere({extension, std::string(input), {{"scene.bin", std::string(1000, '\1')}}}); });
}

/// A child that has said `answer` and has ended.
ReaderChild saying(std::string_view answer) {
    static const bool isSmall = ::setenv("SHADOWBENCH_MAX_VERTICES", "10000", 1) == 0 &&
                                ::setenv("SHADOWBENCH_MAX_TRIANGLES", "10000", 1) == 0; // so that most inputs are quick
    std::array<int, 2> ends{};
    require(isSmall && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0, "there are no sockets");
    Descriptor childs(ends[1]);
    Descriptor ours(ends[0]);
    const ssize_t sent = ::send(childs.get(), answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    require(sent == static_cast<ssize_t>(answer.size()), "an answer is longer than a socket holds");
    return ReaderChild("cannot read a file", std::move(ours));
}

} // namespace

void readMeshAnswer(std::string_view input) {
    ReaderChild child = saying(input);
    const Mesh mesh = receivedMesh(child);
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) require(t[i] < mesh.positions.size(), "a triangle has a corner that the mesh lacks");
}

void readPartsAnswer(std::string_view input) {
    ReaderChild child = saying(input);
    receivedParts(child);
}

void readImageAnswer(std::string_view input) {
    ReaderChild child = saying(input);
    const ImageHeader header = receivedHeader(child);
    require(header.width >= 0 && header.height >= 0 && header.alpha < static_cast<int>(header.channels.size()),
            "an image's header names what it lacks");
}

void readObj(std::string_view input) { readMesh(".obj", input); }
void readPly(std::string_view input) { readMesh(".ply", input); }
void readGltf(std::string_view input) { readMesh(".gltf", input); }
void readGlb(std::string_view input) { readMesh(".glb", input); }

void readImage(std::string_view input) {
    readInAChild([&] {
        DecodedImage image{std::string(input)};
        for (int i = 0; i < static_cast<int>(image.header().channels.size()); ++i) image.channel(i);
    });
}

} // namespace shadowbench::fuzz
