// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// SIGINT, SIGTERM and SIGHUP (a terminal or an ssh session that is gone) become a question that loops over
// frames ask.
#pragma once

namespace spslam {

// From now to the end of the process. The signals then no longer end it, however often they come. SIGHUP
// stays ignored where it is, as under nohup.
void watch_for_interruption();
// The last signal of these that has come, 0 without one.
int interruption();

}  // namespace spslam
