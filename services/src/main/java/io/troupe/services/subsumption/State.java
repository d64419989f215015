package io.troupe.services.subsumption;

import java.util.List;

/**
 * A state of a table: one service for each robot.
 *
 * @param number from 1, in the order of the table
 * @param colour the colour that leads to this state, {@code 0x00RRGGBB}
 * @param services one per robot
 */
public record State(int number, int colour, List<Service> services) {
    public State {
        services = List.copyOf(services);
    }

    /** Whether any robot looks for colours, so that the state can end. */
    public boolean canEnd() {
        return services.stream().anyMatch(Service::findsColours);
    }
}
