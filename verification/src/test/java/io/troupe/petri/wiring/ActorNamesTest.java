package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.CallObserver.Call;
import io.troupe.actor.CallObserver.Party;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** What is kept of calls to connections. That they are attributed to their callers is tested with a broker. */
class ActorNamesTest {
    private final ActorNames names = new ActorNames(name -> false);
    private final Party client = new Named("client");

    private record Named(String name) implements Party {
        @Override
        public String space() {
            return "test";
        }

        @Override
        public int number() {
            return 0;
        }
    }

    /** As in a space, each event has its own object of a call. */
    private record Passed(int id) implements Call {
        @Override
        public Class<?> type() {
            return Runnable.class;
        }

        @Override
        public String method() {
            return "run";
        }

        @Override
        public List<@Nullable Object> arguments() {
            return List.of();
        }

        @Override
        public boolean isRequest() {
            return false;
        }

        @Override
        public boolean isPassedOn() {
            return true;
        }

        @Override
        public void whenSettled(Consumer<@Nullable Throwable> callback) {}
    }

    @Test
    void noteOfACall_isKeptAsLongAsTheConnectionMayPassItOn() {
        for (int id = 0; id < 3; id++) {
            names.passing(client, new Passed(id));
        }
        assertThat(names.notes()).isEqualTo(3);
        names.dropped(new Passed(0));
        assertThat(names.notes()).isEqualTo(2);
        var waits = new Passed(1);
        names.begun(waits);
        names.begun(new Passed(2));
        for (int attempt = 0; attempt < 50 && names.notes() > 1; attempt++) {
            System.gc();
        }
        assertThat(names.notes()).as("of " + waits).isEqualTo(1);
    }
}
