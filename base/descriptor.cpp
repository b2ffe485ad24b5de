#include "base/descriptor.h"

#include "base/error.h"
#include "base/faults.h"

#include <array>
#include <cerrno>
#include <sys/socket.h>
#include <sys/stat.h>
#include <system_error>

namespace shadowbench {

bool isStillNamed(int descriptor, const std::filesystem::path& path) {
    struct stat byName {
    }, byDescriptor{};
    return stat(path.c_str(), &byName) == 0 && fstat(descriptor, &byDescriptor) == 0 &&
           byName.st_ino == byDescriptor.st_ino && byName.st_dev == byDescriptor.st_dev;
}

std::pair<Descriptor, Descriptor> makeSockets() {
    std::array<int, 2> ends{};
    if (faults::fails(faults::Point::Pipe) || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw Inconclusive("cannot speak to another process: " + std::generic_category().message(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

} // namespace shadowbench
