using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;

namespace LagSim.Harness.Reports;

/// <summary>A table of a report, with formatted cells. Columns that hold only numbers are set flush right.</summary>
public sealed class ReportTable
{
    /// <summary>Creates a table.</summary>
    /// <param name="caption">The caption; may be empty.</param>
    /// <param name="columns">The headings, with units.</param>
    /// <param name="rows">The rows, with as many cells as columns; an empty cell or a dash is fine.</param>
    /// <exception cref="ArgumentException">There is no column, or a row has another number of cells.</exception>
    public ReportTable(string caption, IReadOnlyList<string> columns, IReadOnlyList<IReadOnlyList<string>> rows)
    {
        ArgumentNullException.ThrowIfNull(caption);
        ArgumentNullException.ThrowIfNull(columns);
        ArgumentNullException.ThrowIfNull(rows);
        if (columns.Count == 0)
        {
            throw new ArgumentException($"Table '{caption}' has no columns.", nameof(columns));
        }

        for (int i = 0; i < rows.Count; i++)
        {
            if (rows[i].Count != columns.Count)
            {
                throw new ArgumentException($"Table '{caption}': row {i} has {rows[i].Count} cells for {columns.Count} columns.", nameof(rows));
            }
        }

        Caption = caption;
        Columns = columns;
        Rows = rows;
        IsNumeric = columns.Select((_, column) => rows.Count > 0 && rows.All(row => IsNumberOrBlank(row[column]))).ToArray();
    }

    /// <summary>The caption.</summary>
    public string Caption { get; }

    /// <summary>The headings.</summary>
    public IReadOnlyList<string> Columns { get; }

    /// <summary>The cells, row by row.</summary>
    public IReadOnlyList<IReadOnlyList<string>> Rows { get; }

    /// <summary>Whether each column holds only numbers.</summary>
    internal IReadOnlyList<bool> IsNumeric { get; }

    private static bool IsNumberOrBlank(string cell) => cell.Length == 0 || cell is "-" or "\u2013" or "\u2014"
        || double.TryParse(cell, NumberStyles.Float, CultureInfo.InvariantCulture, out _);
}
