package io.troupe.demo.verify;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;

import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.ProtocolBuilder;
import io.troupe.petri.wiring.Wiring;
import java.util.function.IntFunction;

/**
 * The components of {@code troupe run} as declarations: the world in lock step, the service in charge of each robot,
 * the promise of its colour, and the arbitrator.
 *
 * <p>The model does not distinguish services: each may see a colour after any reading, or none. A service that has
 * ended looks like one that waits for readings: a request to stop it is answered at once. A colour always leads to
 * another state, as in the paper's table. Closing a world or an actor space is no call and not part of the model.
 *
 * <p>A running program is compared with {@code MonitoredRunWiring}, which has every message.
 *
 * <p><b>Source.</b> The classes {@code Simulation}, {@code RobotServicesActor} and {@code Arbitrator}. ADR 0003 defines
 * when an actor space has answered a reading.
 */
final class ProvedRunWiring {
    private ProvedRunWiring() {}

    /** The implemented wiring: a service fulfils a promise and does not wait for the arbitrator. */
    static Wiring withPromises(int robots) {
        var wiring = Wiring.of(robots + " robots, colours by promise")
                .component(world(robots, true))
                .components("service", robots, service("promise.fulfil"))
                .components("promise", robots, promise())
                .component(arbitrator(robots));
        for (int i = 1; i <= robots; i++) {
            wiring.bind("service" + i, "promise", "promise" + i);
        }
        return wiring.build();
    }

    /** A wiring to avoid: a service calls the arbitrator and waits until it accepts the colour. */
    static Wiring withDirectCalls(int robots) {
        return Wiring.of(robots + " robots, colours by a call that is waited for")
                .component(world(robots, false))
                .components("service", robots, service("arbitrator.colour"))
                .component(arbitrator(robots))
                .build();
    }

    /**
     * The world's protocol: gives each service its reading, then waits until the actor space is idle and no colour is
     * in transit.
     */
    private static Protocol world(int robots, boolean promises) {
        var world =
                Protocol.of("world").state("new", requests("arbitrator.idle").then("reading 1"));
        chain(world, "reading ", robots, i -> "service" + i + ".data", "waiting 1");
        chain(world, "waiting ", robots, i -> "service" + i + ".answered", promises ? "promised 1" : "settled");
        if (promises) {
            chain(world, "promised ", robots, i -> "promise" + i + ".idle", "settled");
        }
        return world.state("settled", requests("arbitrator.idle").then("reading 1"))
                .build();
    }

    private static Protocol service(String reportsTo) {
        return Protocol.of("service")
                .state("free", provides("begin").then("in charge"))
                .state(
                        "in charge",
                        provides("data").then("deciding"),
                        provides("answered").then("in charge"),
                        provides("stop").then("free"))
                .state(
                        "deciding",
                        does("drive on").then("in charge"),
                        does("see a colour").then("ending"))
                .state("ending", requests(reportsTo).then("in charge"))
                .build();
    }

    private static Protocol promise() {
        return Protocol.of("promise")
                .state(
                        "pending",
                        provides("fulfil").then("fulfilled"),
                        provides("idle").then("pending"))
                .state("fulfilled", requests("arbitrator.colour").then("pending"))
                .build();
    }

    private static Protocol arbitrator(int robots) {
        var arbitrator = Protocol.of("arbitrator").state("new", does("live").then("beginning 1"));
        chain(arbitrator, "beginning ", robots, i -> "service" + i + ".begin", "watching");
        arbitrator
                .state(
                        "watching",
                        provides("colour").then("judging"),
                        provides("idle").then("watching"))
                .state(
                        "judging",
                        does("drop a colour of the state before").then("watching"),
                        does("change the state").then("stopping 1"));
        chain(arbitrator, "stopping ", robots, i -> "service" + i + ".stop", "beginning 1");
        return arbitrator.build();
    }

    /** One request after the other, to the component of each robot. */
    private static void chain(
            ProtocolBuilder protocol, String state, int robots, IntFunction<String> request, String last) {
        for (int i = 1; i <= robots; i++) {
            protocol.state(state + i, requests(request.apply(i)).then(i < robots ? state + (i + 1) : last));
        }
    }
}
