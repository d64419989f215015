package io.troupe.petri.bip;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashSet;
import java.util.List;
import java.util.stream.Collectors;

/**
 * Joins ports of several components. Without a trigger it is a rendezvous: all ports take part, or none. With triggers,
 * every set of its ports that contains a trigger is an interaction, and a larger one goes before a smaller one (maximal
 * progress).
 *
 * {@snippet :
 * var together = Connector.of("together", "left.go", "right.go");
 * var broadcast = Connector.of("broadcast", "sender.send'", "first.receive", "second.receive");
 * }
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> No end, more than {@link #MOST_ENDS} ends with a trigger among them, a component with two ends, and
 * a text that is no {@code component.port} throw {@link IllegalArgumentException}.
 */
public record Connector(String name, List<End> ends) {
    /** The most ends of a connector with triggers: its interactions are the subsets of its ends. */
    public static final int MOST_ENDS = 12;

    /**
     * A port of a component.
     *
     * @param trigger whether the port may take part without the others; otherwise it is a synchron
     */
    public record End(String component, String port, boolean trigger) {
        static End parse(String connector, String text) {
            var trigger = text.endsWith("'");
            var name = trigger ? text.substring(0, text.length() - 1) : text;
            var dot = name.indexOf('.');
            if (dot < 1 || dot == name.length() - 1 || name.indexOf('.', dot + 1) >= 0) {
                throw new IllegalArgumentException("connector " + connector + " has the end \"" + text
                        + "\", expected COMPONENT.PORT, or COMPONENT.PORT' for a trigger");
            }
            return new End(name.substring(0, dot), name.substring(dot + 1), trigger);
        }

        /** {@code component.port}. */
        @Override
        public String toString() {
            return component + "." + port;
        }
    }

    public Connector {
        Names.require("connector", name);
        ends = List.copyOf(ends);
        if (ends.isEmpty()) {
            throw new IllegalArgumentException("connector " + name + " has no ends, expected one or more");
        }
        var components = new HashSet<String>();
        for (var end : ends) {
            if (!components.add(end.component())) {
                throw new IllegalArgumentException("connector " + name + " has two ends at component " + end.component()
                        + ", expected one: a component takes one step at a time");
            }
        }
        if (ends.size() > MOST_ENDS && ends.stream().anyMatch(End::trigger)) {
            throw new IllegalArgumentException("connector " + name + " has " + ends.size()
                    + " ends and a trigger, expected at most " + MOST_ENDS + " ends");
        }
    }

    /**
     * A connector between these ports.
     *
     * @param ends {@code component.port}; a trigger has an apostrophe at its end, as in the BIP language
     */
    public static Connector of(String name, String... ends) {
        return new Connector(
                name, Arrays.stream(ends).map(end -> End.parse(name, end)).toList());
    }

    /** Whether all ports take part, or none. */
    public boolean isRendezvous() {
        return ends.stream().noneMatch(End::trigger);
    }

    /** All interactions, the smallest first. */
    List<Interaction> interactions() {
        if (isRendezvous()) {
            return List.of(new Interaction(this, ends));
        }
        var interactions = new ArrayList<Interaction>();
        for (var size = 1; size <= ends.size(); size++) {
            for (var set = 1; set < 1 << ends.size(); set++) {
                var chosen = subset(set);
                if (Integer.bitCount(set) == size && chosen.stream().anyMatch(End::trigger)) {
                    interactions.add(new Interaction(this, chosen));
                }
            }
        }
        return interactions;
    }

    private List<End> subset(int set) {
        var chosen = new ArrayList<End>();
        for (var i = 0; i < ends.size(); i++) {
            if ((set & 1 << i) != 0) {
                chosen.add(ends.get(i));
            }
        }
        return chosen;
    }

    /** As in the BIP language, with an apostrophe after each trigger. */
    @Override
    public String toString() {
        return ends.stream()
                .map(end -> end + (end.trigger() ? "'" : ""))
                .collect(Collectors.joining(", ", name + "(", ")"));
    }
}
