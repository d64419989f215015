package io.troupe.demo.table;

import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe table}: reads and checks a table, prints it, and draws its states and rules. */
@Command(
        name = "table",
        description = "Checks a table of services, prints it, and draws its states and its switching rules.",
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class TableCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "FILE", arity = "0..1", description = "a table; the paper's unless given")
    private @Nullable Path file;

    @Option(
            names = "--out",
            paramLabel = "DIR",
            description = "where states.dot, states.svg, rules.dot and rules.svg go")
    private Path out = Path.of("out");

    @Mixin
    private ServiceJars jars;

    @Override
    public Integer call() throws IOException {
        SubsumptionTable table = read();
        OutputDirectory.make(spec, out);
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.print(new TableGrid(table).text());
        terminal.println();
        terminal.flush(); // before writing files, which may fail
        write("states", Diagram.ofStates(table));
        write("rules", Diagram.ofRules(table));
        terminal.println("wrote states and rules, as .dot and .svg, in " + out);
        terminal.flush();
        return 0;
    }

    private SubsumptionTable read() {
        try (var opened = jars) {
            var catalogue = opened.catalogue(file);
            return file == null ? SubsumptionTable.ofThePaper() : SubsumptionTableReader.read(file, catalogue);
        }
    }

    private void write(String name, Diagram diagram) throws IOException {
        OutputFiles.write(out.resolve(name + ".dot"), DiagramDot.write(diagram));
        OutputFiles.write(out.resolve(name + ".svg"), DiagramSvg.draw(diagram));
    }
}
