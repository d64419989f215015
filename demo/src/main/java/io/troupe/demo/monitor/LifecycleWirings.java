package io.troupe.demo.monitor;

import static io.troupe.petri.wiring.Protocol.does;

import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import java.util.Set;

/**
 * What a broker does with a provider, and what happens to a request on a bus, as declarations whose private steps are
 * all observed.
 *
 * <p><b>Source.</b> The classes {@code ManagedProvider} and {@code PendingRequests}.
 */
enum LifecycleWirings {
    /**
     * The events of a broker about a provider, which as a component sends no values or notices unless it has been
     * started. One that was withdrawn or replaced may still be stopped.
     */
    PROVIDER(
            "provider",
            Protocol.of("provider")
                    .state(
                            "unknown",
                            does("is registered").then("idle"),
                            does("is being started").then("starting"))
                    .state(
                            "idle",
                            does("is being started").then("starting"),
                            does("leaves").then("left"))
                    .state(
                            "starting",
                            does("sends").then("starting"),
                            does("has started").then("running"),
                            does("could not be started").then("failed"),
                            does("has stopped").then("idle"),
                            does("could not be stopped").then("failed"),
                            does("leaves").then("left while starting"))
                    .state(
                            "running",
                            does("sends").then("running"),
                            does("is suspect").then("suspect"),
                            does("has failed").then("failed"),
                            does("has stopped").then("idle"),
                            does("could not be stopped").then("failed"),
                            does("leaves").then("left"))
                    .state(
                            "suspect",
                            does("sends").then("suspect"),
                            does("has recovered").then("running"),
                            does("has failed").then("failed"),
                            does("has stopped").then("idle"),
                            does("could not be stopped").then("failed"),
                            does("leaves").then("left"))
                    .state(
                            "failed",
                            does("sends").then("failed"),
                            does("is being started").then("starting"),
                            does("has stopped").then("idle"),
                            does("could not be stopped").then("failed"),
                            does("leaves").then("left"))
                    .state(
                            "left while starting",
                            does("sends").then("left while starting"),
                            does("has started").then("left"),
                            does("could not be started").then("left"),
                            does("has stopped").then("left"),
                            does("could not be stopped").then("left"))
                    .state(
                            "left",
                            does("sends").then("left"),
                            does("has failed").then("left"),
                            does("has stopped").then("left"),
                            does("could not be stopped").then("left"),
                            does("is registered").then("idle"))
                    .build()),

    /** A request on a bus: it is answered once. */
    REQUEST(
            "request",
            Protocol.of("request")
                    .state("new", does("is sent").then("open"))
                    .state(
                            "open",
                            does("is answered").then("over"),
                            does("is rejected").then("over"))
                    .state("over", does("is forgotten").then("new"))
                    .build());

    private final String component;
    private final Wiring wiring;

    LifecycleWirings(String component, Protocol protocol) {
        this.component = component;
        this.wiring = Wiring.of(component).component(component, protocol).build();
    }

    String component() {
        return component;
    }

    Wiring wiring() {
        return wiring;
    }

    /** The labels of all steps. */
    Set<String> steps() {
        return switch (this) {
            case PROVIDER ->
                Set.of(
                        "is registered",
                        "is being started",
                        "has started",
                        "could not be started",
                        "is suspect",
                        "has recovered",
                        "has failed",
                        "has stopped",
                        "could not be stopped",
                        "leaves",
                        "sends");
            case REQUEST -> Set.of("is sent", "is answered", "is rejected", "is forgotten");
        };
    }
}
