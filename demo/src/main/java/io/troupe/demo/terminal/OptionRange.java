package io.troupe.demo.terminal;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/** Checks the numbers of options. */
public final class OptionRange {
    private OptionRange() {}

    /**
     * Rejects a number outside of a range.
     *
     * @return the number
     * @throws ParameterException with the option, its value and the expected range
     */
    public static int check(CommandSpec spec, String option, int value, int least, int most) {
        if (value < least || value > most) {
            throw new ParameterException(
                    spec.commandLine(), option + " is " + value + ", expected a number from " + least + " to " + most);
        }
        return value;
    }

    /**
     * Rejects seconds that are not above 0 and at most {@code most}.
     *
     * @throws ParameterException with the value and the expected range
     */
    public static void checkSeconds(CommandSpec spec, double seconds, int most) {
        if (!(seconds > 0) || seconds > most) {
            throw new ParameterException(
                    spec.commandLine(), "--seconds is " + seconds + ", expected a number above 0 and up to " + most);
        }
    }
}
