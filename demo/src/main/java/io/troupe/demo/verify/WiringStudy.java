package io.troupe.demo.verify;

import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import java.util.List;
import java.util.function.Consumer;

/** A wiring declared component by component, and whether it can deadlock. */
record WiringStudy(String name, Wiring wiring, WiringResult result) {
    private static final int MARKINGS_PER_REPORT = 10_000;

    /** The paper's wiring for one robot and for several, with the repair that is proposed, and our own, with promises and with direct calls. */
    static List<WiringStudy> all(int robots, Consumer<String> progress) {
        return List.of(
                of("the paper's four components as declarations", PaperWiring.wiring(), progress),
                of("the same with " + robots + " robots", PaperWiring.robots(robots), progress),
                of(
                        "the same with " + robots + " robots, each of which stops with its player only",
                        PaperWiring.robotsStoppingOneByOne(robots),
                        progress),
                of(
                        "troupe run with " + robots + " robots, a colour is a promise",
                        TroupeWiring.withPromises(robots),
                        progress),
                of(
                        "troupe run with 2 robots, if a colour were a call that is waited for",
                        TroupeWiring.withDirectCalls(2),
                        progress));
    }

    private static WiringStudy of(String name, Wiring wiring, Consumer<String> progress) {
        progress.accept("wiring: " + name);
        var limits = SearchLimits.markings(WiringCheck.DEFAULT_MAX_MARKINGS)
                .reporting(
                        MARKINGS_PER_REPORT,
                        at -> progress.accept("wiring: " + name + ": " + at.markings() + " markings"));
        return new WiringStudy(name, wiring, WiringCheck.check(wiring, limits));
    }

    /** In one or two lines. */
    String verdict() {
        return switch (result) {
            case WiringResult.Deadlock deadlock ->
                "can deadlock: " + deadlock.story().sentence()
                        + deadlock.repair()
                                .map(repair -> "\n    repair: stop together; "
                                        + (repair.isProved() ? "proved free of deadlock" : "not proved"))
                                .orElse("");
            case WiringResult.Blocked blocked ->
                "a component can wait for ever: " + blocked.story().sentence();
            case WiringResult.Proved proved -> proved.toString();
            case WiringResult.DeadlockFree free -> free.toString();
            case WiringResult.Unknown unknown ->
                unknown.toString().lines().findFirst().orElseThrow();
        };
    }
}
