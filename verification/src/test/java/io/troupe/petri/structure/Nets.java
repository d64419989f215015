package io.troupe.petri.structure;

import static io.troupe.petri.PaperNets.Reading.A;

import io.troupe.petri.Composition;
import io.troupe.petri.Meld;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.IntStream;

/** The nets that the tests of this package share. */
final class Nets {
    private static final Map<String, PetriNet> COMPONENTS = Map.of(
            "robot",
            PaperNets.robot(),
            "player",
            PaperNets.player(),
            "middleware",
            PaperNets.middleware(),
            "service",
            PaperNets.service(A));

    private Nets() {}

    static PetriNet paper(Reading reading, boolean corrected) {
        return corrected ? PaperNets.corrected(reading) : PaperNets.uncorrected(reading);
    }

    /** Some components of reading A with the melds of these requests. */
    static PetriNet part(String components, String requests) {
        return Composition.compose(
                components,
                Arrays.stream(components.split(" ")).map(COMPONENTS::get).toList(),
                PaperNets.melds().stream()
                        .filter(meld -> List.of(requests.split(" ")).contains(meld.request()))
                        .toList());
    }

    /** Two robots, each with a separate player, one middleware and one service; corrected with one stop for all. */
    static PetriNet twoRobots(boolean corrected) {
        var service = PaperNets.service(A).toBuilder()
                .remove("Ts7")
                .transition("Ts7", List.of(corrected ? "S10" : "S4"), List.of("S1"))
                .build();
        var components = new ArrayList<>(List.of(PaperNets.middleware(), service));
        var melds = new ArrayList<>(List.of(PaperNets.register(), PaperNets.giveData()));
        for (var i : List.of(1, 2)) {
            components.add(PaperNets.robot().renamed("robot " + i, name -> name + "." + i));
            components.add(PaperNets.player().renamed("player " + i, name -> name + "." + i));
            melds.add(Meld.of("Tr2." + i, "Tp1." + i));
            melds.add(Meld.of("Tr4." + i, "Tp2." + i));
            melds.add(Meld.of("Tp3." + i, "Tm3"));
        }
        var net = Composition.compose("two robots", components, melds);
        return corrected
                ? Composition.fuse(net, "Tstop", List.of("Tr7.1", "Tp4.1", "Tr7.2", "Tp4.2", "Tm4", "Ts7"))
                : net;
    }

    /** Up to 7 places and 7 transitions; every arc has a weight from 1 to {@code maxWeight}. */
    static PetriNet random(long seed, int maxWeight) {
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
}
