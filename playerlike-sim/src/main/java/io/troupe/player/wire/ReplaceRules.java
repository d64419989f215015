package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;

/** The rules of one client: the newest that matches counts, and only so many are kept. */
final class ReplaceRules {
    static final int MAX_RULES = 256;

    private final List<ReplaceRule> rules = new ArrayList<>();

    /** One that speaks of the same messages goes, and the oldest of too many. */
    void add(ReplaceRule rule) {
        rules.removeIf(each -> each.interfaceCode() == rule.interfaceCode()
                && each.index() == rule.index()
                && each.type() == rule.type()
                && each.subtype() == rule.subtype());
        if (rules.size() == MAX_RULES) {
            rules.removeFirst();
        }
        rules.add(rule);
    }

    /** What happens to such a message. */
    int treatment(DeviceAddress from, MessageType type, int subtype) {
        for (int i = rules.size() - 1; i >= 0; i--) {
            if (rules.get(i).matches(from, type.code(), subtype)) {
                return rules.get(i).replace();
            }
        }
        return ReplaceRule.ACCEPT;
    }
}
