package io.troupe.services.subsumption;

/**
 * Parses the services of a {@code state} statement: either one service per robot in order, or services by robot number.
 */
final class AssignmentReader {
    private final TableLine line;
    private final ServiceReader services;
    private final int robots;
    private Assignment assignment = Assignment.none();

    AssignmentReader(TableLine line, ServiceReader services, int robots) {
        this.line = line;
        this.services = services;
        this.robots = robots;
    }

    Assignment read() {
        if (isAtNumbers()) {
            do {
                numbered();
            } while (line.skips(","));
        } else {
            inTurn();
        }
        if (!line.atEnd()) {
            throw line.unexpected("',', '>' or the end of the line");
        }
        return assignment;
    }

    private boolean isAtNumbers() {
        return line.isAt("*") || line.isAtNumber();
    }

    /** {@code SERVICE, SERVICE, ..}. */
    private void inTurn() {
        int robot = 0;
        do {
            int at = line.position();
            if (isAtNumbers()) {
                throw line.unexpected("the service of robot " + (robot + 1) + ", as for those before it");
            }
            Service service = services.layers(line);
            robot++;
            if (robot > robots) {
                throw line.problem(
                        at,
                        "'" + service + "' is for robot " + robot + ", expected services for " + robots + " robots");
            }
            assignment = assignment.robot(robot, service);
        } while (line.skips(","));
        if (robot < robots) {
            throw line.unexpected("',' and the service of robot " + (robot + 1) + " of " + robots);
        }
    }

    /** {@code * = SERVICE}, {@code N = SERVICE} or {@code N..M = SERVICE}. */
    private void numbered() {
        int at = line.position();
        if (line.skips("*")) {
            line.expect("=", "and a service after '*'");
            Service service = services.layers(line);
            TableParser.atPosition(line, at, () -> assignment = assignment.others(service));
            return;
        }
        int first = robot("'*' or the number of a robot, 1 to ");
        int last = line.skips("..") ? robot("the number of a robot, 1 to ") : first;
        line.expect("=", "and a service after the numbers of robots");
        Service service = services.layers(line);
        TableParser.atPosition(line, at, () -> assignment = assignment.robots(first, last, service));
    }

    private int robot(String expected) {
        return line.whole(expected + robots, 1, robots);
    }
}
