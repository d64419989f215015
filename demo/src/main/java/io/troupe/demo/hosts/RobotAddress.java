package io.troupe.demo.hosts;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** Where a Player server offers robots: {@code HOST:PORT}. */
public record RobotAddress(String host, int port) {
    /**
     * Reads the value of {@code --robots}.
     *
     * @throws ParameterException if it is no address
     */
    public static RobotAddress parse(CommandSpec spec, String text) {
        int colon = text.lastIndexOf(':');
        try {
            int port = Integer.parseInt(text.substring(colon + 1));
            if (colon > 0 && port >= 1 && port <= 65_535) {
                return new RobotAddress(text.substring(0, colon), port);
            }
        } catch (NumberFormatException noPort) {
            throw wrong(spec, text);
        }
        throw wrong(spec, text);
    }

    private static ParameterException wrong(CommandSpec spec, String text) {
        return new ParameterException(
                spec.commandLine(),
                "--robots is '" + text + "', expected the address of a Player server, HOST:PORT such as base:6665");
    }

    @Override
    public String toString() {
        return host + ":" + port;
    }
}
