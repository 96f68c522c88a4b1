# SPDX-License-Identifier: MIT
# Comments of the public headers as Doxygen wants them: those before a declaration, those behind a
# member, and the file's own; of docs/cpp.md, links to pages that are not among these.
s:\[([^]]*)\]\([a-z/-]*\.md(#[a-z-]*)?\):\1:g
1s:^/\* SPDX.*$:/** @file\n * SPDX-License-Identifier\: MIT\n *:
1s:^// SPDX.*$:/// @file:
2,14s:^//( |$):/// :
s:^( *)/\* ---- ([^-]*) -+ \*/$:\1/* \2 */:
t
s:^( *)/\* :\1/** :
s:([^ ].*) /\* :\1 /**< :
s:^(.*), /\*\*< (.*)$:\1, /**< \2:
