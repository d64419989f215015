package io.troupe.demo;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine;
import picocli.CommandLine.Help;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Model.UsageMessageSpec;

/** The pages of {@code --help}: as wide as the terminal, examples before the options, and the options in groups. */
final class HelpPage {
    private static final int LEAST_COLUMNS = 60;
    private static final int MOST_COLUMNS = 160;
    private static final int USUAL_COLUMNS = 80;
    /** A page with fewer options is one list. */
    private static final int LEAST_GROUPED = 10;

    private static final String OTHERS = "Also";

    /** The groups of options, in the order of the pages. An option that is in none is among the last but one. */
    private static final Map<String, List<String>> GROUPS = groups("""
            World: --world --crowd --random --side --worlds --lenient --acceleration-bounds
            Clients: --port --bind --clients --max-clients
            Robots and their services: --robots --colours --services --hold --table --services-jar --corners --mode --modes --reconnect --rank
            Time and chance: --seconds --seed --realtime --speed --lock-step
            Page for browsers: --view --view-bind --view-speed --html
            Output: --out --record --mcap --csv --sensors --json
            Bus to other hosts, and application: --bus --bus-user --bus-password-file --bus-trust --application --name
            Also:
            Help: --help --version
            """);

    private HelpPage() {}

    private static Map<String, List<String>> groups(String text) {
        Map<String, List<String>> groups = new LinkedHashMap<>();
        text.lines().forEach(line -> {
            String[] parts = line.split(": ?", 2);
            groups.put(parts[0], List.of(parts[1].split(" ")));
        });
        return groups;
    }

    /** Lays out the pages of a command and of its subcommands. */
    static void layOut(CommandLine troupe, int columns) {
        troupe.setUsageHelpWidth(columns);
        for (CommandLine command : troupe.getSubcommands().values()) {
            layOut(command);
        }
    }

    private static void layOut(CommandLine command) {
        var sections = new ArrayList<>(command.getHelpSectionKeys());
        sections.add(sections.indexOf(UsageMessageSpec.SECTION_KEY_PARAMETER_LIST_HEADING), "examples");
        command.setHelpSectionKeys(sections);
        command.getHelpSectionMap().put("examples", help -> {
            String examples = footer(help, true);
            return examples.isEmpty() ? "" : String.format("%nExamples:%n%s%n", examples);
        });
        command.getHelpSectionMap().put(UsageMessageSpec.SECTION_KEY_FOOTER, help -> footer(help, false));
        command.getHelpSectionMap().put(UsageMessageSpec.SECTION_KEY_OPTION_LIST, HelpPage::options);
        command.getSubcommands().values().forEach(HelpPage::layOut);
    }

    /** The lines of a command's footer that are examples, or the others. */
    private static String footer(Help help, boolean areExamples) {
        String[] lines = Stream.of(help.commandSpec().usageMessage().footer())
                .filter(line -> isExample(line) == areExamples)
                .toArray(String[]::new);
        int columns = help.commandSpec().usageMessage().width();
        return Help.join(help.ansi(), columns, true, lines, new StringBuilder()).toString();
    }

    private static boolean isExample(String line) {
        return line.startsWith("  troupe ");
    }

    /** The commands that the page of a command shows as examples. */
    static List<String> examples(CommandLine command) {
        return Stream.of(command.getCommandSpec().usageMessage().footer())
                .filter(HelpPage::isExample)
                .map(String::strip)
                .toList();
    }

    private static String options(Help help) {
        List<OptionSpec> all = help.commandSpec().options().stream()
                .filter(each -> !each.hidden())
                .toList();
        if (all.size() < LEAST_GROUPED) {
            return help.optionList();
        }
        var text = new StringBuilder();
        GROUPS.forEach((title, names) -> {
            List<OptionSpec> members = all.stream()
                    .filter(each -> groupOf(each.longestName()).equals(title))
                    .sorted((one, other) -> names.indexOf(one.longestName()) - names.indexOf(other.longestName()))
                    .toList();
            if (!members.isEmpty()) {
                var layout = help.createDefaultLayout();
                layout.addOptions(members, help.createDefaultParamLabelRenderer());
                boolean isFirst = text.isEmpty()
                        && help.commandSpec().positionalParameters().isEmpty();
                text.append(isFirst ? "" : System.lineSeparator()).append(title).append(':');
                text.append(System.lineSeparator()).append(layout);
            }
        });
        return text.toString();
    }

    private static String groupOf(String option) {
        return GROUPS.entrySet().stream()
                .filter(each -> each.getValue().contains(option))
                .map(Map.Entry::getKey)
                .findFirst()
                .orElse(OTHERS);
    }

    /** The columns of the terminal: the value of {@code COLUMNS}, else what the start script has found. */
    static int columns(@Nullable String said, @Nullable String found) {
        for (String each : new String[] {said, found}) {
            if (each != null && each.matches("[0-9]{1,6}")) {
                return Math.clamp(Integer.parseInt(each), LEAST_COLUMNS, MOST_COLUMNS);
            }
        }
        return USUAL_COLUMNS;
    }
}
