package io.troupe.checks.architecture;

import static com.tngtech.archunit.base.DescribedPredicate.describe;
import static com.tngtech.archunit.core.domain.JavaClass.Predicates.resideInAnyPackage;
import static com.tngtech.archunit.core.domain.JavaClass.Predicates.resideOutsideOfPackage;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.classes;
import static com.tngtech.archunit.library.dependencies.SlicesRuleDefinition.slices;
import static org.assertj.core.api.Assertions.assertThat;

import com.tngtech.archunit.core.domain.JavaClass;
import com.tngtech.archunit.library.dependencies.SliceAssignment;
import com.tngtech.archunit.library.dependencies.SliceIdentifier;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The allowed dependencies between packages. */
class ArrowsTest {
    /** Without any scanned classes every rule would pass; to be raised as the code grows. */
    private static final int FEWEST_CLASSES = 2_000;

    /** Each package is a room; what generated classes use of actor-core is in the room of the actors. */
    private static final SliceAssignment ROOMS = new SliceAssignment() {
        @Override
        public SliceIdentifier getIdentifierOf(JavaClass type) {
            String name = type.getPackageName();
            return !name.startsWith("io.troupe.")
                    ? SliceIdentifier.ignore()
                    : SliceIdentifier.of(name.equals("io.troupe.actor.internal") ? "io.troupe.actor" : name);
        }

        @Override
        public String getDescription() {
            return "the packages of Troupe";
        }
    };

    @Test
    void scan_seesTheClassesOfTroupe() {
        assertThat(Classes.MAIN.size()).as("classes seen").isGreaterThanOrEqualTo(FEWEST_CLASSES);
        assertThat(Classes.MAIN)
                .extracting(JavaClass::getName)
                .contains("io.troupe.actor.ActorSpace", "io.troupe.sim.model.Scenario");
    }

    @ParameterizedTest
    @CsvSource({
        "common,         io.troupe.common..",
        "drawing,        io.troupe.drawing",
        "tools,          io.troupe.tools",
        "actor-core,     io.troupe.actor..",
        "actor-service,  io.troupe.bus io.troupe.bus.internal io.troupe.broker..",
        "actor-nats,     io.troupe.bus.nats..",
        "actor-kotlin,   io.troupe.actor.kotlin..",
        "actor-micrometer, io.troupe.actor.micrometer..",
        "playerlike-sim, io.troupe.player.. io.troupe.sim..",
        "services,       io.troupe.services..",
        "verification,   io.troupe.petri..",
        "view,           io.troupe.view..",
        "demo,           io.troupe.demo..",
        "paper,          io.troupe.paper..",
        "jmh,            io.troupe.bench..",
        "stress,         io.troupe.actor.. io.troupe.faults.."
    })
    void module_holdsOnlyItsOwnPackages(String module, String packages) {
        classes()
                .should()
                .resideInAnyPackage(packages.split(" "))
                .as("the module " + module + " should hold only " + packages)
                .check(Classes.of(module));
    }

    /**
     * Classes in {@code from} may depend on each other, on the packages in {@code to}, and on classes outside of
     * Troupe. All names begin with {@code io.troupe.}
     */
    @ParameterizedTest
    @CsvSource({
        "actor..,               ''",
        "actor.kotlin,          actor actor.internal actor.internal.loop actor.testkit bus broker",
        "actor.micrometer,      actor",
        "actor.internal.loop,   ''",
        "actor.internal,        actor actor.internal.loop",
        "actor,                 actor.internal actor.internal.loop",
        "actor.testkit..,       actor actor.internal actor.internal.loop",
        "common..,              ''",
        "drawing,               ''",
        "tools,                 common..",
        "bus.internal,          actor.internal.loop common..",
        "bus,                   actor.. common.. bus.internal",
        "bus.nats..,            actor bus",
        "broker..,              actor.. common.. bus bus.internal",
        "player..,              actor.. sim..",
        "sim..,                 actor.. player.. common..",
        "sim.model,             common..",
        "sim.worldfile,         sim.model common..",
        "services..,            actor.. bus bus.internal broker.. player.. common..",
        "petri..,               common.. drawing actor actor.testkit",
        "petri,                 common.. drawing",
        "petri.structure,       petri",
        "petri.deadlock,        petri petri.structure",
        "petri.bip,             petri common..",
        "petri.drawing,         petri petri.bip drawing",
        "view..,                actor.. bus broker.. player.. sim.. services.. common.. drawing",
        "paper,                 actor.. player.. sim.. services.."
    })
    void room_importsOnlyTheRoomsThatItMay(String from, String to) {
        var rooms = Stream.of((from + " " + to).split(" ")).map(room -> "io.troupe." + room);
        var allowed = resideInAnyPackage(rooms.toArray(String[]::new)).or(resideOutsideOfPackage("io.troupe.."));
        classes()
                .that()
                .resideInAPackage("io.troupe." + from)
                .and()
                .resideOutsideOfPackage(from.endsWith("..") ? "io.troupe.actor.kotlin.." : "") // a room over its own
                .should()
                .onlyDependOnClassesThat(describe("reside in no other room of Troupe than itself and " + to, allowed))
                .check(Classes.MAIN);
    }

    @Test
    void actorCore_takesOnlyItsFewLibraries() {
        classes()
                .should()
                .onlyDependOnClassesThat()
                .resideInAnyPackage(
                        "io.troupe.actor..",
                        "java..",
                        "javax.management..",
                        "jdk.jfr..",
                        "org.jspecify.annotations..",
                        "org.objectweb.asm..")
                .check(Classes.of("actor-core"));
    }

    @Test
    void packages_haveNoCycles() {
        slices().assignedFrom(ROOMS).should().beFreeOfCycles().check(Classes.MAIN);
    }
}
