package io.troupe.demo.verify;

import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import java.util.List;
import java.util.function.Consumer;

/** A wiring declared component by component, and whether it can deadlock. */
record WiringStudy(String name, Wiring wiring, WiringResult result) {
    private static final int ROBOTS = 2;

    /** The paper's wiring, with its repair, and our own, with promises and with direct calls. */
    static List<WiringStudy> all(Consumer<String> progress) {
        return List.of(
                of("the paper's four components as declarations", PaperWiring.wiring(), progress),
                of(
                        "troupe run, " + ROBOTS + " robots, a colour is a promise",
                        TroupeWiring.withPromises(ROBOTS),
                        progress),
                of(
                        "troupe run, " + ROBOTS + " robots, if a colour were a call that is waited for",
                        TroupeWiring.withDirectCalls(ROBOTS),
                        progress));
    }

    private static WiringStudy of(String name, Wiring wiring, Consumer<String> progress) {
        progress.accept("wiring: " + name);
        return new WiringStudy(name, wiring, WiringCheck.check(wiring));
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
            case WiringResult.Unknown unknown -> "not known: no dead marking up to the limit, " + unknown.figures();
        };
    }
}
