using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;

namespace LagSim.Harness.Reports;

/// <summary>
/// A writer of comma-separated values by RFC 4180: a header, rows that end in CR LF, and quotes only where a value needs them.
/// </summary>
/// <remarks>
/// It streams: a row is with the <see cref="TextWriter"/> once <see cref="WriteRow"/> returns. The caller flushes and closes the writer.
/// Invariant culture; floating-point numbers read back exactly. Not thread-safe.
/// </remarks>
public sealed class CsvFile
{
    private readonly TextWriter _output;
    private readonly int _columns;

    /// <summary>Starts a file by writing its header.</summary>
    /// <param name="output">The destination.</param>
    /// <param name="header">The names of the columns, with their units: <c>time_s</c>.</param>
    /// <exception cref="ArgumentException">There is no column, or two have the same name.</exception>
    public CsvFile(TextWriter output, params string[] header)
    {
        ArgumentNullException.ThrowIfNull(output);
        ArgumentNullException.ThrowIfNull(header);
        if (header.Length == 0 || new HashSet<string>(header).Count != header.Length)
        {
            throw new ArgumentException($"A CSV header needs columns, each of another name; got '{string.Join(',', header)}'.", nameof(header));
        }

        _output = output;
        _columns = header.Length;
        WriteFields(header);
    }

    /// <summary>Writes one row. Null is an empty field; <c>true</c> and <c>false</c> are lower case.</summary>
    /// <exception cref="ArgumentException">The number of values is not that of the columns.</exception>
    public void WriteRow(params object?[] values)
    {
        ArgumentNullException.ThrowIfNull(values);
        if (values.Length != _columns)
        {
            throw new ArgumentException($"This CSV row has {values.Length} values for {_columns} columns.", nameof(values));
        }

        WriteFields(values);
    }

    private void WriteFields(object?[] values)
    {
        for (int i = 0; i < values.Length; i++)
        {
            _output.Write(i == 0 ? "" : ",");
            _output.Write(Quote(Text(values[i])));
        }

        // A row of one empty field would be an empty line, which readers skip.
        _output.Write(values.Length == 1 && Text(values[0]).Length == 0 ? "\"\"\r\n" : "\r\n");
    }

    private static string Text(object? value) => value switch
    {
        null => "",
        double number => NumberText.RoundTrip(number),
        float number => number.ToString("R", CultureInfo.InvariantCulture),
        bool truth => truth ? "true" : "false",
        IFormattable formattable => formattable.ToString(null, CultureInfo.InvariantCulture),
        _ => value.ToString() ?? "",
    };

    private static string Quote(string field) =>
        field.AsSpan().IndexOfAny("\",\r\n") < 0 ? field : "\"" + field.Replace("\"", "\"\"", StringComparison.Ordinal) + "\"";
}
