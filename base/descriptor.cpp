#include "base/descriptor.h"

#include "base/error.h"

#include <array>
#include <cerrno>
#include <sys/socket.h>
#include <system_error>

namespace shadowbench {

std::pair<Descriptor, Descriptor> makeSockets() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw Inconclusive("cannot speak to another process: " + std::generic_category().message(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

} // namespace shadowbench
