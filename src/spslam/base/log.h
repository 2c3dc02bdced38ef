// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Logging goes through spdlog's default logger of the process that uses the library; the library never
// configures it.
#pragma once

#include <spdlog/spdlog.h>
