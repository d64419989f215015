package io.troupe.petri;

import io.troupe.petri.PaperNets.Reading;
import java.util.ArrayList;
import java.util.List;
import java.util.function.UnaryOperator;
import java.util.stream.IntStream;

/**
 * The nets of {@link PaperNets} for several robots. Each robot has a separate player; all share one middleware and one
 * service, in reading A. Names of robot {@code i} (from 1) and its player end in {@code .i}.
 *
 * <p><b>Errors.</b> Fewer than one robot throws {@link IllegalArgumentException}.
 */
public final class RobotTeams {
    private RobotTeams() {}

    /** Every component may stop at any time: 2 x 3^n dead markings for n robots. */
    public static PetriNet uncorrected(int robots) {
        return team("uncorrected", robots, "S4");
    }

    /**
     * All components stop together by {@code Tstop}, once every robot is ready to stop and the others wait for a call.
     */
    public static PetriNet stoppingTogether(int robots) {
        var stops = new ArrayList<String>();
        numbers(robots).forEach(i -> stops.addAll(List.of("Tr7." + i, "Tp4." + i)));
        stops.addAll(List.of("Tm4", "Ts7"));
        return Composition.fuse(team("stopping together", robots, "S10"), "Tstop", stops);
    }

    /** Each robot stops together with its player by {@code Tstop.i}; the middleware and the service never stop. */
    public static PetriNet stoppingOneByOne(int robots) {
        var net = team("stopping one by one", robots, "S10").toBuilder()
                .remove("Tm4")
                .remove("Ts7")
                .build();
        for (var i : numbers(robots)) {
            net = Composition.fuse(net, "Tstop." + i, List.of("Tr7." + i, "Tp4." + i));
        }
        return net;
    }

    private static List<Integer> numbers(int robots) {
        if (robots < 1) {
            throw new IllegalArgumentException("robots is " + robots + ", expected 1 or more");
        }
        return IntStream.rangeClosed(1, robots).boxed().toList();
    }

    private static PetriNet team(String name, int robots, String serviceStopsAt) {
        var components = new ArrayList<PetriNet>();
        var melds = new ArrayList<Meld>();
        for (var i : numbers(robots)) {
            UnaryOperator<String> mine = each -> each + "." + i;
            components.add(PaperNets.robot().renamed("robot " + i, mine));
            components.add(PaperNets.player().renamed("player " + i, mine));
            melds.add(renamed(PaperNets.getProxies(), mine, mine));
            melds.add(renamed(PaperNets.setValues(), mine, mine));
            // one offer of the middleware for all players
            melds.add(renamed(PaperNets.transmit(), mine, UnaryOperator.identity()));
        }
        components.add(PaperNets.middleware());
        components.add(PaperNets.service(Reading.A, serviceStopsAt));
        melds.add(PaperNets.register());
        melds.add(PaperNets.giveData());
        return Composition.compose(name + " " + robots, components, melds);
    }

    private static Meld renamed(Meld meld, UnaryOperator<String> requestor, UnaryOperator<String> provider) {
        return new Meld(
                requestor.apply(meld.request()),
                provider.apply(meld.offer()),
                requestor.apply(meld.asking()),
                requestor.apply(meld.waiting()),
                requestor.apply(meld.accept()),
                requestor.apply(meld.pending()),
                provider.apply(meld.before()),
                provider.apply(meld.after()),
                requestor.apply(meld.answer()));
    }
}
