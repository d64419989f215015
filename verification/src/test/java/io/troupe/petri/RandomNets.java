package io.troupe.petri;

import java.util.LinkedHashSet;
import java.util.Random;

/** Small random nets for tests; the same random numbers give the same net. */
public final class RandomNets {
    private RandomNets() {}

    /** One of the two kinds below. */
    public static PetriNet any(Random random) {
        return random.nextInt(3) == 0 ? tangle(random, random.nextInt(3) == 0) : components(random);
    }

    /** Any arcs and weights, often unbounded. */
    static PetriNet tangle(Random random, boolean prioritised) {
        var net = PetriNet.builder("tangle");
        var places = 2 + random.nextInt(6);
        for (var p = 0; p < places; p++) {
            net.place("p" + p, random.nextInt(2) == 0 ? 1 + random.nextInt(4) : 0);
        }
        var transitions = 2 + random.nextInt(6);
        for (var t = 0; t < transitions; t++) {
            net.transition("t" + t);
            if (prioritised) {
                net.priority("t" + t, random.nextInt(3));
            }
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
    static PetriNet components(Random random) {
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
