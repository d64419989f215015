package io.troupe.petri;

import static java.util.stream.Collectors.joining;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayList;
import java.util.Collections;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;

/** The nets and assertions that tests share; the same random numbers give the same net. */
public final class Nets {
    private Nets() {}

    public static void refused(ThrowingCallable call, String message) {
        assertThatIllegalArgumentException().isThrownBy(call).withMessage(message);
    }

    /** The messages of the exceptions of these calls, in a line each. */
    public static String refusals(ThrowingCallable... calls) {
        return Stream.of(calls)
                .map(call -> assertThatIllegalArgumentException()
                        .isThrownBy(call)
                        .actual()
                        .getMessage())
                .collect(joining("\n"));
    }

    /** A small net in words: {@code net("carts", "parts=5 cart", "make: 2*parts > cart", "sell: cart >")}. */
    public static PetriNet net(String name, String places, String... transitions) {
        var net = PetriNet.builder(name);
        for (var place : words(places)) {
            var parts = place.split("=");
            net.place(parts[0], parts.length == 1 ? 0 : Long.parseLong(parts[1]));
        }
        for (var transition : transitions) {
            var parts = transition.split(" *[:>]", -1);
            net.transition(parts[0]);
            for (var arc : words(parts[1])) {
                net.arc(arc.replaceAll(".*\\*", ""), parts[0], weight(arc));
            }
            for (var arc : words(parts[2])) {
                net.arc(parts[0], arc.replaceAll(".*\\*", ""), weight(arc));
            }
        }
        return net.build();
    }

    private static int weight(String arc) {
        return arc.contains("*") ? Integer.parseInt(arc.replaceAll("\\*.*", "")) : 1;
    }

    private static List<String> words(String text) {
        return text.isBlank() ? List.of() : List.of(text.strip().split(" "));
    }

    public static PetriNet paper(Reading reading, boolean corrected) {
        return corrected ? PaperNets.corrected(reading) : PaperNets.uncorrected(reading);
    }

    /** Some components of reading A with the melds of these requests. */
    public static PetriNet part(String components, String requests) {
        var all =
                Stream.of(PaperNets.robot(), PaperNets.player(), PaperNets.middleware(), PaperNets.service(Reading.A));
        return Composition.compose(
                components,
                all.filter(net -> words(components).contains(net.name())).toList(),
                PaperNets.melds().stream()
                        .filter(meld -> words(requests).contains(meld.request()))
                        .toList());
    }

    /** n switches that are switched once, in any order: 2^n markings, n 2^(n-1) edges, one dead marking. */
    static PetriNet switches(int count) {
        var net = PetriNet.builder("switches");
        for (var i = 0; i < count; i++) {
            net.place("off" + i, 1).place("on" + i).transition("t" + i, List.of("off" + i), List.of("on" + i));
        }
        return net.build();
    }

    /** Each of n steps goes left or right, irrevocably: 2^n dead markings, n firings away. */
    static PetriNet choices(int count) {
        var net = PetriNet.builder("choices").place("p0", 1);
        for (var i = 0; i < count; i++) {
            net.place("l" + i).place("r" + i).place("p" + (i + 1));
            net.transition("left" + i, List.of("p" + i), List.of("l" + i, "p" + (i + 1)));
            net.transition("right" + i, List.of("p" + i), List.of("r" + i, "p" + (i + 1)));
        }
        return net.build();
    }

    /** Up to 7 places and 7 transitions; every arc has a weight from 1 to {@code maxWeight}. */
    public static PetriNet sparse(long seed, int maxWeight) {
        var random = new Random(seed);
        var net = PetriNet.builder("seed " + seed);
        var places = 2 + random.nextInt(6);
        IntStream.range(0, places).forEach(p -> net.place("p" + p, random.nextInt(3) == 0 ? 1 + random.nextInt(2) : 0));
        var transitions = 1 + random.nextInt(7);
        for (var t = 0; t < transitions; t++) {
            net.transition("t" + t);
            for (var place : drawn(random, places)) {
                net.arc("p" + place, "t" + t, 1 + random.nextInt(maxWeight));
            }
            for (var place : drawn(random, places)) {
                net.arc("t" + t, "p" + place, 1 + random.nextInt(maxWeight));
            }
        }
        return net.build();
    }

    /** Mostly one or two different places. */
    private static Set<Integer> drawn(Random random, int places) {
        var drawn = new TreeSet<Integer>();
        for (var count = random.nextInt(10) == 0 ? 0 : 1 + random.nextInt(2); count > 0; count--) {
            drawn.add(random.nextInt(places));
        }
        return drawn;
    }

    /** One of the two kinds below. */
    public static PetriNet any(Random random) {
        return random.nextInt(3) == 0 ? tangle(random, random.nextInt(3) == 0) : components(random);
    }

    /** The net with some inhibitor arcs of weight 1 or 2. */
    public static PetriNet inhibited(PetriNet net, Random random) {
        var copy = net.toBuilder();
        for (var t : net.transitions()) {
            while (random.nextInt(3) == 0) {
                var place =
                        net.places().get(random.nextInt(net.places().size())).name();
                copy.remove(t.name()).transition(t.name()).priority(t.name(), t.priority());
                t.inputs().forEach(arc -> copy.arc(arc.place().name(), t.name(), arc.weight()));
                t.outputs().forEach(arc -> copy.arc(t.name(), arc.place().name(), arc.weight()));
                copy.inhibitor(place, t.name(), 1 + random.nextInt(2));
            }
        }
        return copy.build();
    }

    /** An arc of a step: its kind (0 in, 1 out, 2 inhibitor), and the place of this part, another one, or all. */
    private record Leg(int kind, int owner, int place, int weight) {
        static final int THIS = 0;
        static final int OTHER = 1;
        static final int ALL = 2;

        String place(int part, int other) {
            return owner == ALL ? "all" + place : "own" + place + "." + (owner == THIS ? part : other);
        }
    }

    /**
     * So many equal parts, which share places and may take steps of two parts, with weights, inhibitor arcs and
     * priorities; places and transitions come in any order.
     */
    public static PetriNet parts(int parts, Random random) {
        var size = 1 + random.nextInt(3);
        var shared = random.nextInt(3);
        var places = new ArrayList<Map.Entry<String, Integer>>();
        for (var p = 0; p < size; p++) {
            var tokens = p == 0 || random.nextInt(5) == 0 ? 1 : 0;
            for (var i = 0; i < parts; i++) {
                places.add(Map.entry("own" + p + "." + i, tokens));
            }
        }
        for (var p = 0; p < shared; p++) {
            places.add(Map.entry("all" + p, random.nextInt(3)));
        }
        Collections.shuffle(places, random);
        var net = PetriNet.builder("parts");
        places.forEach(place -> net.place(place.getKey(), place.getValue()));
        var steps = new ArrayList<Runnable>();
        var isPrioritised = random.nextInt(4) == 0;
        for (var kind = 1 + random.nextInt(4); kind > 0; kind--) {
            var isOfTwo = random.nextInt(4) == 0;
            var legs = legs(size, shared, isOfTwo, random);
            var priority = isPrioritised ? random.nextInt(2) : 0;
            for (var i = 0; i < parts; i++) {
                for (var j = 0; j < parts; j++) {
                    if (isOfTwo ? i != j : j == 0) {
                        var name = "t" + kind + "." + i + "." + j;
                        var part = i;
                        var other = j;
                        steps.add(() -> step(net, name, priority, legs, part, other));
                    }
                }
            }
        }
        Collections.shuffle(steps, random);
        steps.forEach(Runnable::run);
        return net.build();
    }

    private static List<Leg> legs(int size, int shared, boolean isOfTwo, Random random) {
        var legs = new ArrayList<Leg>();
        for (var kind = 0; kind < 3; kind++) {
            var count = kind == 2 ? random.nextInt(5) / 3 : random.nextInt(8) == 0 ? 0 : 1 + random.nextInt(2);
            for (; count > 0; count--) {
                var isShared = shared > 0 && random.nextInt(3) == 0;
                var owner = isShared ? Leg.ALL : isOfTwo && random.nextBoolean() ? Leg.OTHER : Leg.THIS;
                legs.add(new Leg(kind, owner, random.nextInt(isShared ? shared : size), 1 + random.nextInt(4) / 3));
            }
        }
        return legs;
    }

    private static void step(PetriNetBuilder net, String name, int priority, List<Leg> legs, int part, int other) {
        net.transition(name).priority(name, priority);
        var seen = new HashSet<String>();
        for (var leg : legs) {
            var place = leg.place(part, other);
            if (seen.add(leg.kind() + place)) {
                switch (leg.kind()) {
                    case 0 -> net.arc(place, name, leg.weight());
                    case 1 -> net.arc(name, place, leg.weight());
                    default -> net.inhibitor(place, name, leg.weight());
                }
            }
        }
    }

    /**
     * Chains that begin again: each step may need a further unit, and the last one gives back what the steps took, or
     * something else. Other steps change one kind of units into another, or use them up.
     */
    public static PetriNet chains(Random random) {
        var net = PetriNet.builder("chains");
        var units = 2 + random.nextInt(5);
        IntStream.range(0, units).forEach(u -> net.place("u" + u, random.nextInt(3) / 2 + random.nextInt(2)));
        var next = 0;
        for (var c = 1 + random.nextInt(2); c > 0; c--) {
            var length = 2 + random.nextInt(4);
            var taken = new ArrayList<String>();
            net.place("c" + c + "s0", 1);
            for (var i = 0; i < length; i++) {
                var step = "c" + c + "t" + i;
                net.transition(step).arc("c" + c + "s" + i, step);
                if (random.nextInt(3) > 0) {
                    taken.add("u" + (random.nextInt(4) == 0 ? random.nextInt(units) : next++ % units));
                    net.arc(taken.getLast(), step);
                }
                if (i < length - 1) {
                    net.place("c" + c + "s" + (i + 1)).arc(step, "c" + c + "s" + (i + 1));
                } else {
                    net.arc(step, "c" + c + "s0");
                    taken.add("u" + random.nextInt(units));
                    taken.stream()
                            .distinct()
                            .filter(unit -> random.nextInt(5) > 0)
                            .forEach(unit -> net.arc(step, unit));
                }
            }
        }
        for (var i = random.nextInt(4); i > 0; i--) {
            net.transition("x" + i).arc("u" + random.nextInt(units), "x" + i);
            if (random.nextInt(3) > 0) {
                net.arc("x" + i, "u" + random.nextInt(units));
            }
        }
        return net.build();
    }

    /** Any arcs and weights, often unbounded. */
    private static PetriNet tangle(Random random, boolean prioritised) {
        var net = PetriNet.builder("tangle");
        var places = 2 + random.nextInt(6);
        for (var p = 0; p < places; p++) {
            net.place("p" + p, random.nextInt(2) == 0 ? 1 + random.nextInt(4) : 0);
        }
        var transitions = 2 + random.nextInt(6);
        for (var t = 0; t < transitions; t++) {
            net.transition("t" + t).priority("t" + t, prioritised ? random.nextInt(3) : 0);
            for (var p = 0; p < places; p++) {
                if (random.nextInt(3) == 0) {
                    net.arc("p" + p, "t" + t, 1 + random.nextInt(2));
                }
                if (random.nextInt(4) == 0) {
                    net.arc("t" + t, "p" + p, 1 + random.nextInt(2));
                }
            }
        }
        return net.build();
    }

    /** State machines, each with one or two tokens, which share some of their steps; always bounded. */
    private static PetriNet components(Random random) {
        var net = PetriNet.builder("components");
        var components = 2 + random.nextInt(4);
        var places = 2 + random.nextInt(4);
        for (var c = 0; c < components; c++) {
            net.place("c" + c + "p0", random.nextInt(6) == 0 ? 2 : 1);
            for (var p = 1; p < places; p++) {
                net.place("c" + c + "p" + p);
            }
        }
        var transitions = components * (2 + random.nextInt(4));
        for (var t = 0; t < transitions; t++) {
            net.transition("t" + t);
            var partners = new LinkedHashSet<Integer>();
            for (var i = random.nextInt(4) / 2; i >= 0; i--) {
                partners.add(random.nextInt(components));
            }
            for (var c : partners) {
                var from = random.nextInt(places);
                var to = random.nextInt(5) == 0 ? from : random.nextInt(places);
                net.arc("c" + c + "p" + from, "t" + t);
                net.arc("t" + t, "c" + c + "p" + to);
            }
        }
        return net.build();
    }
}
