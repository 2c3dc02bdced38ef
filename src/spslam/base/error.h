// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Errors at construction and IO are exceptions; within a run a bad frame is a status (docs/ARCHITECTURE.md).
#pragma once

#include <stdexcept>
#include <string>

namespace spslam {

// Every message says what is wrong, where, and what to do about it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The data read is missing, damaged or contradicts itself.
class InputError : public Error {
 public:
  using Error::Error;
};

// An option or a command line is wrong.
class OptionError : public Error {
 public:
  using Error::Error;
};

// A result could not be written.
class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace spslam
