#include "base/error.h"

#include <cerrno>

namespace shadowbench {

Failure failureOf(int errorNumber) {
    switch (errorNumber) {
    case ENOSPC:
    case EDQUOT:
    case ENOMEM:
    case EAGAIN:
    case EINTR:
    case EMFILE:
    case ENFILE:
    case EIO: // of a network file system, as the next two
    case ESTALE:
    case ETIMEDOUT:
        return Failure::Transient;
    default:
        return Failure::Lasting;
    }
}

} // namespace shadowbench
