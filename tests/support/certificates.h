// What tests say of the certificates of references.
#pragma once

#include "base/error.h"
#include "groundtruth/certify/certificate.h"

#include <fmt/format.h>
#include <string>

namespace shadowbench::groundtruth {

/// Its members, for messages.
inline std::string describe(const Certificate& certificate) {
    std::string text;
    for (const auto& [key, value] : measured(certificate)) text += fmt::format("{} {:g}, ", key, value);
    return text;
}

/// Why `require`, requireCertified or requireSkyCertified, refuses a certificate; empty if it does not.
inline std::string rejection(void (*require)(const Certificate&, int), const Certificate& certificate, int samples) {
    try {
        require(certificate, samples);
        return "";
    } catch (const Inconclusive& error) {
        return error.what();
    }
}

} // namespace shadowbench::groundtruth
