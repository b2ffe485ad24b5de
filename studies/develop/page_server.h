// The page of a LiveState, for browsers of this machine alone.
#pragma once

#include "studies/develop/live_state.h"

#include <memory>

namespace shadowbench::develop {

/// Answers on the loopback address: requests that name another host, and those that change something and come from another
/// page, are refused (docs/threat-model.md). Knows its own pages and pictures, no files.
class PageServer {
public:
    /// On a free port. `state` must outlive the object.
    explicit PageServer(LiveState& state);
    /// Closes the state.
    ~PageServer();
    PageServer(const PageServer&) = delete;
    PageServer& operator=(const PageServer&) = delete;

    [[nodiscard]] int port() const;

private:
    struct Running;
    std::unique_ptr<Running> running_;
};

} // namespace shadowbench::develop
