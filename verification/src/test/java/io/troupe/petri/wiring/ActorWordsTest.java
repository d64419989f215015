package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.emits;
import static io.troupe.petri.wiring.Protocol.finishes;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.receives;
import static io.troupe.petri.wiring.Protocol.rejects;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.streams;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorTypeException;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** The words of a declaration are compared with the methods of the actor's type. */
class ActorWordsTest {
    interface Cache {
        Promise<String> get(String key);

        void put(String key, String value);

        Promise<Boolean> put(String key, String value, int days);

        void forget(String key);

        void watch(String key, Callback<String> values);

        Promise<Integer> load(String file, Callback<Integer> progress);

        default boolean isSmall() { // no message: it runs at its caller
            return true;
        }
    }

    private static Protocol protocol(Branch branch) {
        return Protocol.of("cache", Cache.class).state("ready", branch).build();
    }

    static Branch[] wordsThatFit() {
        return new Branch[] {
            provides("get").then("ready"),
            rejects("get").then("ready"),
            receives("put").then("ready"), // of two overloads, one is a message
            provides("put").then("ready"), // and the other one a request
            receives("forget").then("ready"),
            streams("watch").then("ready"),
            receives("watch").then("ready"), // without its results
            streams("load").then("ready"),
            provides("load").then("ready"),
            requests("disk.read").then("ready") // compared with the declaration of the disk
        };
    }

    @ParameterizedTest
    @MethodSource
    void wordsThatFit(Branch branch) {
        assertThat(protocol(branch).states()).containsExactly("ready");
    }

    @Test
    void itemsAndTheEnd_areOfAStream() {
        var protocol = Protocol.of("cache", Cache.class)
                .state("ready", streams("watch").then("open"))
                .state("open", emits("watch").then("open"), finishes("watch").then("ready"))
                .build();
        assertThat(protocol.isStream("watch")).isTrue();
    }

    private void assertRefused(Branch branch, String message) {
        assertThatThrownBy(() -> protocol(branch))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("protocol cache: state ready " + branch + ", but " + Cache.class.getName() + message);
    }

    @Test
    void wordThatTheTypeDoesNotHave_isRefused_withTheNearest() {
        assertRefused(
                provides("gett").then("ready"),
                " has no message gett; did you mean get? known: forget, get, load, put, watch");
        assertRefused(
                provides("isSmall").then("ready"), " has no message isSmall; known: forget, get, load, put, watch");
    }

    @Test
    void wordOfAnotherKind_isRefused_withTheRightOne() {
        assertRefused(
                provides("forget").then("ready"),
                ".forget(String) is a one-way message; expected receives(\"forget\")");
        assertRefused(receives("get").then("ready"), ".get(String) is a request; expected provides(\"get\")");
        assertRefused(
                provides("watch").then("ready"),
                ".watch(String, Callback) is a stream of results and a one-way message; expected streams(\"watch\") or"
                        + " receives(\"watch\")");
        assertRefused(streams("get").then("ready"), ".get(String) is a request; expected provides(\"get\")");
        assertRefused(
                receives("load").then("ready"),
                ".load(String, Callback) is a request and a stream of results; expected provides(\"load\") or"
                        + " streams(\"load\")");
    }

    interface NoActor {
        int size();
    }

    @Test
    void typeThatIsNoActorType_isRefused() {
        assertThatThrownBy(() -> Protocol.of("cache", NoActor.class))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("size");
    }
}
