// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/loss.h"

#include <utility>

namespace geomend {

const char* to_string(LossClass c) {
    constexpr const char* names[] = {"substance", "identity", "style"};
    return names[static_cast<std::size_t>(c)];
}

void add_loss(std::vector<Loss>& losses, Loss loss) {
    for (Loss& known : losses) {
        if (known.loss_class == loss.loss_class && known.entity == loss.entity && known.what == loss.what && known.why == loss.why) {
            known.count += loss.count;
            return;
        }
    }
    losses.push_back(std::move(loss));
}

}  // namespace geomend
