// Meshes and images are read by libraries, in a child that can reach nothing (base/confined/). Here it is a worker
// (tests/fuzz/worker.h): what counts is that our own code makes no mistake, whatever the library does. And what a child that
// its file has taken over might answer, as this process reads it.
#include "base/confined/decoded_image.h"
#include "base/confined/image_reader.h"
#include "base/error.h"
#include "scene/meshes/foreign_mesh.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/worker.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <sys/socket.h>

namespace shadowbench::fuzz {
namespace {

void requireSound(const Mesh& mesh) {
    for (const glm::vec3& p : mesh.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "a position is not finite");
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) require(t[i] < mesh.positions.size(), "a triangle has a corner that the mesh lacks");
}

/// In the worker: what was read must be as the reader's parent asks for.
std::string readMesh(const char* extension, std::string_view input) {
    const Mesh mesh = readMeshHere({extension, std::string(input), {{"scene.bin", std::string(1000, '\1')}}});
    requireSound(mesh);
    return std::string(std::bit_width(mesh.positions.size()), 'v') + std::string(std::bit_width(mesh.triangles.size()), 't');
}

std::string readAnyImage(std::string_view input) {
    static const bool isSmall = ::setenv("SHADOWBENCH_MAX_PIXELS", "1000000", 1) == 0; // so that most inputs are quick
    require(isSmall, "there is no environment");
    DecodedImage image{std::string(input)};
    for (int i = 0; i < static_cast<int>(image.header().channels.size()); ++i) image.channel(i);
    return image.header().format + std::string(image.header().channels.size(), 'c');
}

/// A child that has said `answer` and has ended.
ReaderChild saying(std::string_view answer) {
    static const bool isSmall = ::setenv("SHADOWBENCH_MAX_VERTICES", "10000", 1) == 0 &&
                                ::setenv("SHADOWBENCH_MAX_TRIANGLES", "10000", 1) == 0 &&
                                ::setenv("SHADOWBENCH_MAX_PIXELS", "10000", 1) == 0; // so that most inputs are quick
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
    requireSound(receivedMesh(child));
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

void readObj(std::string_view input) {
    static Worker worker([](std::string_view text) { return readMesh(".obj", text); });
    worker.read(input);
}

void readPly(std::string_view input) {
    static Worker worker([](std::string_view text) { return readMesh(".ply", text); });
    worker.read(input);
}

void readGltf(std::string_view input) {
    static Worker worker([](std::string_view text) { return readMesh(".gltf", text); });
    worker.read(input);
}

void readGlb(std::string_view input) {
    static Worker worker([](std::string_view bytes) { return readMesh(".glb", bytes); });
    worker.read(input);
}

void readImage(std::string_view input) {
    static Worker worker(readAnyImage);
    worker.read(input);
}

} // namespace shadowbench::fuzz
