package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;

/** The replace rules of one client: the newest matching rule applies, and their number is bounded. */
final class ReplaceRules {
    static final int MAX_RULES = 256;

    private final List<ReplaceRule> rules = new ArrayList<>();

    /** Adds a rule. It replaces a rule for the same messages; if there are too many rules, the oldest is dropped. */
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

    /** The treatment of such a message: ACCEPT, REPLACE or IGNORE. */
    int treatment(DeviceAddress from, MessageType type, int subtype) {
        for (int i = rules.size() - 1; i >= 0; i--) {
            if (rules.get(i).matches(from, type.code(), subtype)) {
                return rules.get(i).replace();
            }
        }
        return ReplaceRule.ACCEPT;
    }
}
