package io.troupe.petri;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.Supplier;

/**
 * The contents of a document with their line numbers. An arc may come before its ends, so the net is built when the
 * whole document has been read.
 */
final class PnmlDocument {
    enum Kind {
        PLACE,
        TRANSITION
    }

    /** A place or transition. The label is its name, if it has one; the value is its tokens or its priority. */
    record Node(Kind kind, String id, String label, long value, int line) {}

    record Reference(Kind kind, String id, String target, int line) {}

    /** An arc, with the ids of its ends. */
    record Link(String id, String source, String target, int weight, boolean inhibits, int line) {}

    private record Ends(String from, String to) {}

    private final String source;
    private final Map<String, Node> nodes = new LinkedHashMap<>();
    private final Map<String, Reference> references = new LinkedHashMap<>();
    private final List<Link> links = new ArrayList<>();

    PnmlDocument(String source) {
        this.source = source;
    }

    void add(Node node) {
        nodes.put(node.id(), node);
    }

    void add(Reference reference) {
        references.put(reference.id(), reference);
    }

    void add(Link link) {
        links.add(link);
    }

    /** Whether a place, a transition or a reference has this id. The ids of arcs are not kept. */
    boolean has(String id) {
        return nodes.containsKey(id) || references.containsKey(id);
    }

    PetriNet build(String name) {
        var net = at(0, () -> PetriNet.builder(name));
        var byLabel = nodes.values().stream().map(Node::label).distinct().count() == nodes.size();
        for (var node : nodes.values()) {
            var called = byLabel ? node.label() : node.id();
            if (node.kind() == Kind.PLACE) {
                at(node.line(), () -> net.place(called, node.value()));
            } else {
                at(node.line(), () -> net.transition(called).priority(called, (int) node.value()));
            }
        }
        references.values().forEach(reference -> resolve(reference.id(), reference.line()));
        var weights = new LinkedHashMap<Ends, Integer>();
        var lines = new HashMap<Ends, Integer>();
        var inhibitors = new LinkedHashMap<Ends, Integer>();
        for (var link : links) {
            var from = resolve(link.source(), link.line());
            var to = resolve(link.target(), link.line());
            var ends = byLabel ? new Ends(from.label(), to.label()) : new Ends(from.id(), to.id());
            if (link.inhibits()) {
                if (from.kind() != Kind.PLACE || to.kind() != Kind.TRANSITION) {
                    throw bad(
                            "inhibitor arc " + link.id() + " goes from " + ends.from() + " to " + ends.to()
                                    + ", expected from a place to a transition",
                            link.line());
                }
                inhibitors.merge(ends, link.weight(), Math::min);
                continue;
            }
            var weight = (long) weights.getOrDefault(ends, 0) + link.weight();
            if (weight > Integer.MAX_VALUE) {
                throw bad(
                        "the arcs from " + ends.from() + " to " + ends.to() + " weigh " + weight
                                + " together, expected at most " + Integer.MAX_VALUE,
                        link.line());
            }
            weights.put(ends, (int) weight);
            lines.put(ends, link.line());
        }
        weights.forEach((ends, weight) -> at(lines.get(ends), () -> net.arc(ends.from(), ends.to(), weight)));
        inhibitors.forEach((ends, weight) -> net.inhibitor(ends.from(), ends.to(), weight));
        return net.build();
    }

    /** The place or transition that an arc refers to, directly or through reference nodes. */
    private Node resolve(String id, int line) {
        var seen = new HashSet<String>();
        var target = id;
        for (var reference = references.get(id); reference != null; reference = references.get(target)) {
            if (!seen.add(target)) {
                throw bad("reference " + target + " refers to itself", reference.line());
            }
            target = reference.target();
            var node = nodes.get(target);
            if (node != null && node.kind() != reference.kind()) {
                var kind = reference.kind().name().toLowerCase(Locale.ROOT);
                throw bad("a reference to a " + kind + " names " + target + ", which is none", reference.line());
            }
        }
        var node = nodes.get(target);
        if (node == null) {
            throw bad("there is no place or transition with id " + target, line);
        }
        return node;
    }

    private PnmlException bad(String reason, int line) {
        return new PnmlException(source, line, reason, null);
    }

    /** Runs {@code step}; what the builder rejects becomes an error of that line. */
    private <T> T at(int line, Supplier<T> step) {
        try {
            return step.get();
        } catch (IllegalArgumentException e) {
            throw new PnmlException(source, line, String.valueOf(e.getMessage()), e);
        }
    }
}
