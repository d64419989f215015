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
                .in("off", does("start").then("started"))
                .in("started", requests("player.getProxies").then("driving"))
                .in("driving", does("read sensors").then("sensed"))
                .in("sensed", requests("player.setValues").then("set"))
                .in("set", does("go on").then("driving"), does("decide to stop").then("leaving"))
                .in("leaving", stops())
                .build();
    }

    public static Protocol player() {
        return Protocol.of("player")
                .in("idle", provides("getProxies").then("ready"))
                .in("ready", provides("setValues").then("loaded"), stops())
                .in("loaded", requests("middleware.receive").then("ready"))
                .build();
    }

    public static Protocol middleware() {
        return Protocol.of("middleware")
                .in("idle", provides("register").then("ready"))
                .in("ready", provides("receive").then("loaded"), stops())
                .in("loaded", requests("service.receive").then("ready"))
                .build();
    }

    public static Protocol service() {
        return Protocol.of("service")
                .in("idle", requests("middleware.register").then("registered"))
                .in("registered", does("get ready").then("ready"), stops())
                .in("ready", provides("receive").then("decides"))
                .in(
                        "decides",
                        does("choose wall follower").then("following"),
                        does("choose wanderer").then("wandering"))
                .in("following", does("follow the wall").then("registered"))
                .in("wandering", does("wander").then("registered"))
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
