package io.troupe.checks.architecture;

import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noClasses;

import com.tngtech.archunit.core.domain.JavaClasses;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The libraries that each module and package may use. */
class LibrariesTest {
    @ParameterizedTest
    @CsvSource({
        "io.nats..,                io.troupe.bus.nats io.troupe.bench.bus",
        "tools.jackson..,          io.troupe.bench.bus",
        "com.fasterxml.jackson..,  io.troupe.bench.bus",
        "org.jbox2d..,             io.troupe.sim.physics io.troupe.bench.worlds",
        "org.dyn4j..,              io.troupe.bench.worlds",
        "org.objectweb.asm..,      io.troupe.actor",
        "kotlin..,                 io.troupe.actor.kotlin.. io.troupe.bench",
        "kotlinx..,                io.troupe.actor.kotlin.. io.troupe.bench",
        "io.micrometer..,          io.troupe.actor.micrometer",
        "org.eclipse.elk..,        io.troupe.petri.drawing",
        "org.eclipse.emf..,        io.troupe.petri.drawing",
        "org.eclipse.xtext..,      io.troupe.petri.drawing",
        "com.google.common..,      io.troupe.petri.drawing",
        "org.assertj..,            io.troupe.petri.testkit",
        "org.junit..,              io.troupe.petri.testkit",
        "org.jctools..,            io.troupe.bench..",
        "io.vertx..,               io.troupe.bench..",
        "org.apache.pekko..,       io.troupe.bench..",
        "org.nustaq..,             io.troupe.bench..",
        "picocli..,                io.troupe.demo.. io.troupe.bench..",
        "org.openjdk.jmh..,        io.troupe.bench..",
        "org.openjdk.jcstress..,   none"
    })
    void library_staysInItsRooms(String library, String rooms) {
        check(library, Classes.MAIN, rooms.split(" "));
    }

    @Test
    void jmh_staysOutOfTheStressModule() {
        check("org.openjdk.jmh..", Classes.STRESS, "none");
    }

    private static void check(String library, JavaClasses classes, String... rooms) {
        noClasses()
                .that()
                .resideOutsideOfPackages(rooms)
                .should()
                .dependOnClassesThat()
                .resideInAPackage(library)
                .check(classes);
    }
}
