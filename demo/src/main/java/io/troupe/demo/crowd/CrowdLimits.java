package io.troupe.demo.crowd;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** Limits of crowd options, and a range check. */
public final class CrowdLimits {
    public static final int MOST_SERVICES = 100;

    private CrowdLimits() {}

    /**
     * Rejects a number that is not from 1 to {@code most}.
     *
     * @return the number
     * @throws ParameterException with the option, its value and the expected range
     */
    public static int check(CommandSpec spec, String option, int value, int most) {
        if (value < 1 || value > most) {
            throw new ParameterException(
                    spec.commandLine(), option + " is " + value + ", expected a number from 1 to " + most);
        }
        return value;
    }
}
