package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.stops;

import java.util.Set;
import java.util.stream.IntStream;

/**
 * The paper's four components as declarations, in the reading in which the service first takes a private step.
 *
 * <p><b>Errors.</b> Fewer than one robot throws {@link IllegalArgumentException}.
 *
 * <p><b>Source.</b> Section 5 of the paper.
 */
public final class PaperWiring {
    private PaperWiring() {}

    public static Protocol robot() {
        return Protocol.of("robot")
                .state("off", does("start").then("started"))
                .state("started", requests("player.getProxies").then("driving"))
                .state("driving", does("read sensors").then("sensed"))
                .state("sensed", requests("player.setValues").then("set"))
                .state(
                        "set",
                        does("go on").then("driving"),
                        does("decide to stop").then("leaving"))
                .state("leaving", stops())
                .build();
    }

    public static Protocol player() {
        return Protocol.of("player")
                .state("idle", provides("getProxies").then("ready"))
                .state("ready", provides("setValues").then("loaded"), stops())
                .state("loaded", requests("middleware.receive").then("ready"))
                .build();
    }

    public static Protocol middleware() {
        return Protocol.of("middleware")
                .state("idle", provides("register").then("ready"))
                .state("ready", provides("receive").then("loaded"), stops())
                .state("loaded", requests("service.receive").then("ready"))
                .build();
    }

    public static Protocol service() {
        return Protocol.of("service")
                .state("idle", requests("middleware.register").then("registered"))
                .state("registered", does("get ready").then("ready"), stops())
                .state("ready", provides("receive").then("decides"))
                .state(
                        "decides",
                        does("choose wall follower").then("following"),
                        does("choose wanderer").then("wandering"))
                .state("following", does("follow the wall").then("registered"))
                .state("wandering", does("wander").then("registered"))
                .build();
    }

    /** The wiring with one of each component. */
    public static Wiring wiring() {
        return Wiring.of("paper")
                .component(robot())
                .component(player())
                .component(middleware())
                .component(service())
                .build();
    }

    /** Each robot has a separate player session; all share the middleware and the service. */
    public static Wiring robots(int count) {
        var wiring =
                Wiring.of(count + " robots").components("robot", count, robot()).components("player", count, player());
        for (var i = 1; i <= count; i++) {
            wiring.bind("robot" + i, "player", "player" + i);
        }
        return wiring.component(middleware()).component(service()).build();
    }

    /** Each robot stops together with its player session; the middleware and the service never stop. */
    public static Wiring robotsStoppingOneByOne(int count) {
        return robots(count)
                .withSynchronisedStops(IntStream.rangeClosed(1, count)
                        .mapToObj(i -> Set.of("robot" + i, "player" + i))
                        .toList());
    }
}
