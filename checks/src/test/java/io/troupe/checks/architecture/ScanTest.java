package io.troupe.checks.architecture;

import static org.assertj.core.api.Assertions.assertThat;

import com.tngtech.archunit.core.domain.JavaClass;
import org.junit.jupiter.api.Test;

/** Guards the other tests: without any scanned classes every rule would pass. */
class ScanTest {
    /** To be raised as the code grows. */
    private static final int FEWEST_CLASSES = 250;

    @Test
    void scan_seesTheClassesOfTroupe() {
        assertThat(Classes.MAIN.size()).as("classes seen").isGreaterThanOrEqualTo(FEWEST_CLASSES);
        assertThat(Classes.MAIN)
                .extracting(JavaClass::getName)
                .contains("io.troupe.actor.ActorSpace", "io.troupe.sim.model.Scenario");
    }
}
