using System;
using System.Collections.Generic;
using System.IO;
using System.Threading;
using Spectre.Console;
using Spectre.Console.Rendering;

namespace LagSim.Cli.Output;

/// <summary>The destination of results and progress.</summary>
internal sealed class ToolConsole
{
    private const int WidthOfAFile = 150;
    private const int UsualWidth = 80;

    private Action<string> tellPart = _ => { };

    internal ToolConsole(TextWriter output, TextWriter error, CancellationToken stop)
    {
        Stop = stop;
        Output = output;
        Error = error;
        IsTerminal = ReferenceEquals(output, Console.Out) && !Console.IsOutputRedirected;
        Rich = AnsiConsole.Create(new AnsiConsoleSettings
        {
            Out = new AnsiConsoleOutput(output),
            Ansi = IsTerminal ? AnsiSupport.Detect : AnsiSupport.No,
            ColorSystem = IsTerminal ? ColorSystemSupport.Detect : ColorSystemSupport.NoColors,
        });
        if (!IsTerminal)
        {
            Rich.Profile.Width = WidthOfAFile; // else a table in a file is broken at 80 columns
        }
    }

    /// <summary>Whether lines may have any length, since the output is a file or pipe.</summary>
    internal bool IsEndless => !IsTerminal && Rich.Profile.Width == WidthOfAFile;

    /// <summary>Whether output goes to a terminal of at least the usual width.</summary>
    internal bool IsWindow => !IsEndless && Rich.Profile.Width >= UsualWidth;

    /// <summary>Cancels long work.</summary>
    internal CancellationToken Stop { get; }

    /// <summary>Whether results are shown live.</summary>
    internal bool IsTerminal { get; }

    /// <summary>The standard input.</summary>
    internal TextReader Input => Console.In;

    /// <summary>The results, as plain text.</summary>
    internal TextWriter Output { get; }

    /// <summary>Progress and log.</summary>
    internal TextWriter Error { get; }

    /// <summary>The results, as tables.</summary>
    internal IAnsiConsole Rich { get; }

    /// <summary>
    /// Writes a table. A terminal of less than 80 columns without room for it gets each row as a list, so that no cell is broken.
    /// </summary>
    internal void Write(Table table)
    {
        bool isTooWide = Rich.Profile.Width < UsualWidth
            && ((IRenderable)table).Measure(RenderOptions.Create(Rich, Rich.Profile.Capabilities), WidthOfAFile * 10).Max > Rich.Profile.Width;
        Rich.Write(isTooWide ? AsList(table) : table);
    }

    private static Rows AsList(Table table)
    {
        List<IRenderable> parts = table.Title is null ? [] : [new Text(table.Title.Text)];
        foreach (TableRow row in table.Rows)
        {
            Grid cells = new Grid().AddColumn(new GridColumn().NoWrap()).AddColumn();
            for (int n = 0; n < table.Columns.Count; n++)
            {
                cells.AddRow(table.Columns[n].Header, row[n]);
            }

            parts.Add(Text.Empty);
            parts.Add(cells);
        }

        parts.Add(Text.Empty);
        return new Rows(parts);
    }

    /// <summary>
    /// Runs long work, with a progress bar on the error stream if that is a terminal, else with a line at the start and for each named
    /// part.
    /// </summary>
    /// <param name="title">The name of the work.</param>
    /// <param name="length">The amount of work, in simulated seconds.</param>
    /// <param name="work">The work. It reports its progress from time to time.</param>
    /// <param name="isBarShown">Whether a bar is allowed: not over results that scroll on the same terminal.</param>
    /// <exception cref="OperationCanceledException">The user has asked for an end.</exception>
    internal T WithProgress<T>(string title, double length, Func<Action<double>, T> work, bool isBarShown = true)
    {
        if (!isBarShown || !ReferenceEquals(Error, Console.Error) || Console.IsErrorRedirected)
        {
            Error.WriteLine($"{title} ...");
            tellPart = part => Error.WriteLine($"  {part}");
            return work(_ => Pause());
        }

        return AnsiConsole.Create(new AnsiConsoleSettings { Out = new AnsiConsoleOutput(Error) }).Progress()
            .Columns(new TaskDescriptionColumn(), new ProgressBarColumn(), new PercentageColumn(), new RemainingTimeColumn())
            .Start(progress =>
            {
                ProgressTask task = progress.AddTask(Markup.Escape(title), maxValue: length);
                tellPart = part => task.Description = Markup.Escape($"{title}: {part}");
                T result = work(done =>
                {
                    Pause();
                    task.Value = done;
                });
                task.Description = Markup.Escape(title);
                task.Value = Stop.IsCancellationRequested ? task.Value : task.MaxValue;
                return result;
            });
    }

    /// <summary>Names the part of the work that begins now: on the bar, or as a line of the error stream where there is none.</summary>
    internal void Begin(string part) => tellPart(part);

    /// <summary>Restores what a progress bar hides.</summary>
    internal static void ShowCursor()
    {
        if (!Console.IsErrorRedirected)
        {
            AnsiConsole.Create(new AnsiConsoleSettings { Out = new AnsiConsoleOutput(Console.Error) }).Cursor.Show();
        }
    }

    /// <summary>
    /// Between two units of work: stops if cancelled, and flushes the output, so that a closed pipe is noticed.
    /// </summary>
    private void Pause()
    {
        Stop.ThrowIfCancellationRequested();
        Output.Flush();
    }
}
