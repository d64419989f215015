package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class WorldSettingsTest {
    @Test
    void settings_withOneThingChanged_keepTheOthers() {
        WorldSettings settings = WorldSettings.DEFAULT
                .withSeed(7)
                .withJitter(0.02, 0.03)
                .withPhysicsStepMicros(20_000)
                .withLimits(1, 2)
                .withWatchdogMicros(500_000)
                .withSensingThreads(3);

        assertThat(settings).isEqualTo(new WorldSettings(7, 0.02, 0.03, 20_000, 1, 2, 500_000, 3));
    }

    @Test
    void settings_withANumberThatMakesNoSense_nameIt() {
        assertThatThrownBy(() -> WorldSettings.DEFAULT.withJitter(-0.1, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("jitterM is -0.1, expected a finite number, 0 or more");
        assertThatThrownBy(() -> WorldSettings.DEFAULT.withLimits(1, Double.NaN))
                .hasMessageContaining("maxTurnRadps is NaN");
        assertThatThrownBy(() -> WorldSettings.DEFAULT.withPhysicsStepMicros(0))
                .hasMessageContaining("physicsStepMicros is 0");
        assertThatThrownBy(() -> WorldSettings.DEFAULT.withSensingThreads(0))
                .hasMessageContaining("sensingThreads is 0");
    }
}
