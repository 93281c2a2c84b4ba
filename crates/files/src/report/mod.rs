//! The report: `report.json` for scripts, `report.html` for people.
