package io.troupe.services.subsumption;

import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Assigns a service to each robot, by robot number or range: {@code Assignment.everyRobot(SPACE_WANDERER).robots(3, 5,
 * WALL_FOLLOWER)}.
 *
 * <p><b>Role.</b> Immutable. <b>Units and shapes.</b> Robots are numbered from 1.
 */
public final class Assignment {
    private static final Assignment EMPTY = new Assignment(null, List.of());

    private record Range(int first, int last, Service service) {}

    private final @Nullable Service everyOther;
    private final List<Range> ranges;

    private Assignment(@Nullable Service everyOther, List<Range> ranges) {
        this.everyOther = everyOther;
        this.ranges = List.copyOf(ranges);
    }

    /** An empty assignment. */
    public static Assignment none() {
        return EMPTY;
    }

    /** Assigns a service to all robots that have none by number. */
    public static Assignment everyRobot(Service service) {
        return EMPTY.others(service);
    }

    /**
     * Returns an assignment that gives a service to all robots that have none by number.
     *
     * @throws IllegalArgumentException if there is such a service already
     */
    public Assignment others(Service service) {
        if (everyOther != null) {
            throw new IllegalArgumentException(
                    "all other robots are given " + everyOther + " and " + service + " without an order, " + EXPECTED);
        }
        return new Assignment(service, ranges);
    }

    /** Returns an assignment that gives a service to one more robot. */
    public Assignment robot(int number, Service service) {
        return robots(number, number, service);
    }

    /**
     * Returns an assignment that gives a service to a range of robots.
     *
     * @param first first robot of the range
     * @param last last robot of the range, inclusive
     * @throws IllegalArgumentException if {@code first} is less than 1 or more than {@code last}, or one of the robots
     *     has a service by number already
     */
    public Assignment robots(int first, int last, Service service) {
        if (first < 1 || first > last) {
            throw new IllegalArgumentException(
                    "robots " + first + ".." + last + ", expected numbers from 1, the smaller one first");
        }
        for (Range range : ranges) {
            if (range.first <= last && first <= range.last) {
                throw new IllegalArgumentException("robot " + StrictMath.max(first, range.first) + " is given "
                        + range.service + " and " + service + " without an order, " + EXPECTED);
            }
        }
        var more = new ArrayList<>(ranges);
        more.add(new Range(first, last, service));
        return new Assignment(everyOther, more);
    }

    private static final String EXPECTED =
            "expected one service, or layers (the upper one first) made with over(..) or '>'";

    /**
     * Returns the services of robots 1 to {@code robots}, in this order.
     *
     * @throws IllegalArgumentException if a robot has no service, or a range goes beyond the last robot
     */
    public List<Service> services(int robots) {
        var services = new @Nullable Service[robots];
        for (Range range : ranges) {
            if (range.last > robots) {
                throw new IllegalArgumentException(
                        "robot " + range.last + " is given " + range.service + ", expected numbers up to " + robots);
            }
            for (int number = range.first; number <= range.last; number++) {
                services[number - 1] = range.service;
            }
        }
        return IntStream.range(0, robots)
                .mapToObj(index -> service(services[index], index + 1))
                .toList();
    }

    private Service service(@Nullable Service named, int number) {
        Service service = named == null ? everyOther : named;
        if (service == null) {
            throw new IllegalArgumentException("robot " + number + " has no service, expected one for each robot");
        }
        return service;
    }
}
