package io.troupe.services.subsumption;

import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * Robot services behind one interface, each through a separate connection to its provider: {@code drive} goes to the
 * connection for its service, and {@code stop} to the one that drives the robot. Used on one space.
 */
final class RoutedServices implements RobotServices {
    private final Map<String, RobotServices> byService;
    private final Map<Integer, RobotServices> driving = new HashMap<>(); // by robot; the last one

    /** @param byService at least one */
    RoutedServices(Map<String, RobotServices> byService) {
        this.byService = new LinkedHashMap<>(byService);
    }

    @Override
    public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
        return route(robot, service).drive(robot, service, stateColour);
    }

    @Override
    public void drive(int robot, String service, Callback<ColourReport> reports) {
        route(robot, service).drive(robot, service, reports);
    }

    private RobotServices route(int robot, String service) {
        // any provider rejects a service that is not in the table, by its name
        RobotServices to =
                byService.getOrDefault(service, byService.values().iterator().next());
        driving.put(robot, to);
        return to;
    }

    @Override
    public Promise<@Nullable Void> stop(int robot) {
        RobotServices by = driving.get(robot);
        return by == null ? Promise.done() : by.stop(robot);
    }
}
