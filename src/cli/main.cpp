// SPDX-License-Identifier: AGPL-3.0-or-later
int main() { return 0; }
