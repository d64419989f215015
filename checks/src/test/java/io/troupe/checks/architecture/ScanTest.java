package io.troupe.checks.architecture;

import static org.assertj.core.api.Assertions.assertThat;

import com.tngtech.archunit.core.domain.JavaClass;
import org.junit.jupiter.api.Test;

/** A scan that sees nothing would let every rule pass. */
class ScanTest {
    /** Raise it as the code grows. */
    private static final int FEWEST_CLASSES = 250;

    @Test
    void scan_seesTheClassesOfTroupe() {
        assertThat(Classes.MAIN.size()).as("classes seen").isGreaterThanOrEqualTo(FEWEST_CLASSES);
        assertThat(Classes.MAIN)
                .extracting(JavaClass::getName)
                .contains("io.troupe.actor.ActorSpace", "io.troupe.sim.scenario.Scenario");
    }
}
