package io.troupe.demo.verify;

import io.troupe.common.text.Plural;
import io.troupe.demo.monitor.RunWiring;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.services.subsumption.Mode;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

/** A wiring declared component by component, and the result of its deadlock check. */
record WiringStudy(String name, Wiring wiring, WiringResult result) {
    private static final int MARKINGS_PER_REPORT = 10_000;

    /**
     * Checks the paper's wiring for one robot and for several, with the proposed repair, and our wiring with promises
     * and with direct calls.
     *
     * @param done called with each study as soon as it is known
     */
    static List<WiringStudy> all(int robots, Consumer<String> progress, Consumer<WiringStudy> done) {
        String team = Plural.of(robots, "robot");
        Map<String, Wiring> wirings = new LinkedHashMap<>();
        wirings.put("the paper's four components as declarations", PaperWiring.wiring());
        wirings.put("the same with " + team, PaperWiring.robots(robots));
        wirings.put(
                "the same with " + team + ", each of which stops with its player only",
                PaperWiring.robotsStoppingOneByOne(robots));
        wirings.put("troupe run with " + team + ", a colour is a promise", RunWiring.of(Mode.PROMISE, robots));
        wirings.put(
                "troupe run with 2 robots, if a colour were a call that is waited for", RunWiring.withDirectCalls(2));
        return wirings.entrySet().stream()
                .map(each -> of(each.getKey(), each.getValue(), progress))
                .peek(done)
                .toList();
    }

    private static WiringStudy of(String name, Wiring wiring, Consumer<String> progress) {
        progress.accept("wiring: " + name);
        var limits = SearchLimits.markings(WiringCheck.DEFAULT_MAX_MARKINGS)
                .reporting(
                        MARKINGS_PER_REPORT,
                        at -> progress.accept("wiring: " + name + ": " + at.markings() + " markings"));
        return new WiringStudy(name, wiring, WiringCheck.check(wiring, limits));
    }

    /** The result in one or two lines. */
    String verdict() {
        return switch (result) {
            case WiringResult.Deadlock deadlock ->
                "can deadlock: " + deadlock.counterexample().sentence()
                        + deadlock.repair()
                                .map(repair -> "\n    repair: stop together; "
                                        + (repair.isProved() ? "proved free of deadlock" : "not proved"))
                                .orElse("");
            case WiringResult.Blocked blocked ->
                "a component can wait for ever: " + blocked.counterexample().sentence();
            case WiringResult.Proved proved -> proved.toString();
            case WiringResult.DeadlockFree free -> free.toString();
            case WiringResult.Unknown unknown ->
                unknown.toString().lines().findFirst().orElseThrow();
        };
    }
}
